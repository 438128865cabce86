# importon_add_kernels(TARGET NAMESPACE NAMESPACE_NAME HEADER FILE SOURCES FILES...)
#
# Compiles compute shaders to SPIR-V, validates them (a module that spirv-val rejects breaks the build), and
# embeds them in the static library TARGET. Its header HEADER declares in NAMESPACE_NAME:
#   std::span<const std::uint32_t> spirv(std::string_view name);   name: a shader's file stem
#   std::span<const std::string_view> names();                     sorted
# Includes are found from the shaders folder. glslangValidator writes a dependency file per shader, so an edit
# rebuilds what includes the edited file and nothing else.

find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

function(importon_add_kernels target)
  cmake_parse_arguments(PARSE_ARGV 1 ARG "" "NAMESPACE;HEADER" "SOURCES")
  get_filename_component(cmakeFolder ${CMAKE_CURRENT_FUNCTION_LIST_DIR} ABSOLUTE)
  get_filename_component(shaderFolder ${cmakeFolder}/../shaders ABSOLUTE)
  set(outFolder ${CMAKE_CURRENT_BINARY_DIR}/${target}.generated)
  file(MAKE_DIRECTORY ${outFolder}/spirv)

  set(modules)
  list(SORT ARG_SOURCES COMPARE FILE_BASENAME)
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(name ${source} NAME_WE)
    get_filename_component(source ${source} ABSOLUTE)
    set(module ${outFolder}/spirv/${name}.spv)
    add_custom_command(
      OUTPUT ${module}
      COMMAND ${GLSLANG_VALIDATOR} -V --target-env vulkan1.2 --quiet -I${shaderFolder}
              --depfile ${module}.d -o ${module} ${source}
      COMMAND ${SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${module}
      DEPENDS ${source}
      DEPFILE ${module}.d
      COMMENT "Kernel ${name}"
      VERBATIM)
    list(APPEND modules ${module})
  endforeach()

  importon_write_kernel_registry(${target} ${outFolder} ${cmakeFolder} ${ARG_HEADER} ${ARG_NAMESPACE} "${modules}")
  add_library(${target} STATIC ${outFolder}/registry.cpp ${outFolder}/modules.S)
  set_source_files_properties(${outFolder}/modules.S PROPERTIES OBJECT_DEPENDS "${modules}")
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC ${outFolder}/include)
endfunction()

# Writes the header, the table of names and the assembly that takes in `modules`.
function(importon_write_kernel_registry target outFolder cmakeFolder HEADER NAMESPACE modules)
  set(DECLARATIONS "")
  set(NAMES "")
  set(MODULES "")
  set(assembly "/* The SPIR-V modules, each with its end. */\n.section .rodata\n")
  list(LENGTH modules COUNT)
  foreach(module IN LISTS modules)
    get_filename_component(name ${module} NAME_WE)
    set(symbol ${target}_${name})
    string(APPEND DECLARATIONS "extern \"C\" const std::uint32_t ${symbol}[], ${symbol}_end[];\n")
    string(APPEND NAMES "    \"${name}\",\n")
    string(APPEND MODULES "    Module{${symbol}, ${symbol}_end},\n")
    string(APPEND assembly ".balign 4\n.global ${symbol}, ${symbol}_end\n${symbol}:\n.incbin \"${module}\"\n${symbol}_end:\n")
  endforeach()
  string(APPEND assembly ".section .note.GNU-stack,\"\",%progbits\n")
  configure_file(${cmakeFolder}/kernel_registry.h.in ${outFolder}/include/${HEADER} @ONLY)
  configure_file(${cmakeFolder}/kernel_registry.cpp.in ${outFolder}/registry.cpp @ONLY)
  file(CONFIGURE OUTPUT ${outFolder}/modules.S CONTENT "${assembly}")
endfunction()
