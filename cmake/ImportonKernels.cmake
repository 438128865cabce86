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

  set(embedded)
  set(names)
  list(SORT ARG_SOURCES)
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(name ${source} NAME_WE)
    get_filename_component(source ${source} ABSOLUTE)
    set(module ${outFolder}/spirv/${name}.spv)
    set(cppFile ${outFolder}/spirv/${name}.cpp)
    add_custom_command(
      OUTPUT ${module} ${cppFile}
      COMMAND ${GLSLANG_VALIDATOR} -V --target-env vulkan1.2 --quiet -I${shaderFolder}
              --depfile ${module}.d -o ${module} ${source}
      COMMAND ${SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${module}
      COMMAND ${CMAKE_COMMAND} -DMODULE=${module} -DOUTPUT=${cppFile} -DSYMBOL=${name}
              -DNAMESPACE=${ARG_NAMESPACE} -P ${cmakeFolder}/EmbedSpirv.cmake
      DEPENDS ${source} ${cmakeFolder}/EmbedSpirv.cmake
      DEPFILE ${module}.d
      COMMENT "Kernel ${name}"
      VERBATIM)
    list(APPEND embedded ${cppFile})
    list(APPEND names ${name})
  endforeach()

  importon_write_kernel_registry(${outFolder} ${cmakeFolder} ${ARG_HEADER} ${ARG_NAMESPACE} "${names}")
  add_library(${target} STATIC ${outFolder}/registry.cpp ${embedded})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC ${outFolder}/include)
endfunction()

# Writes the header and the table of names for the modules `names`.
function(importon_write_kernel_registry outFolder cmakeFolder HEADER NAMESPACE names)
  set(DECLARATIONS "")
  set(NAMES "")
  set(MODULES "")
  list(LENGTH names COUNT)
  foreach(name IN LISTS names)
    string(APPEND DECLARATIONS "extern const std::span<const std::uint32_t> ${name};\n")
    string(APPEND NAMES "    \"${name}\",\n")
    string(APPEND MODULES "    &embedded::${name},\n")
  endforeach()
  configure_file(${cmakeFolder}/kernel_registry.h.in ${outFolder}/include/${HEADER} @ONLY)
  configure_file(${cmakeFolder}/kernel_registry.cpp.in ${outFolder}/registry.cpp @ONLY)
endfunction()
