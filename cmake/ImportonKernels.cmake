# importon_add_kernels(TARGET NAMESPACE SOURCES FILES...)
#
# Compiles compute shaders to SPIR-V, optimises and validates them (src/gpu/modules/optimise_module.cpp), and embeds them in
# the static library TARGET with a typed call for each: NAME.comp is called by importon::NAMESPACE::Name of
# <NAMESPACE/name.h> (src/gpu/modules/describe_kernels.cpp). <NAMESPACE/registry.h> has all by name.
# Buffers need no binding: glslang numbers those that have none.
# Includes are found from the shaders folder. glslangValidator writes a dependency file per shader, so an edit
# rebuilds what includes the edited file and nothing else. What the optimiser made is kept in IMPORTON_KERNEL_CACHE, so
# that a second build of the same, with other options, need not wait for it.

set(IMPORTON_KERNEL_CACHE "" CACHE PATH "Folder that keeps optimised kernels for other builds of the same")

find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)

function(importon_add_kernels target namespace)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "SOURCES")
  get_filename_component(shaderFolder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../shaders ABSOLUTE)
  set(outFolder ${CMAKE_CURRENT_BINARY_DIR}/${target}.generated)
  file(MAKE_DIRECTORY ${outFolder}/spirv)

  set(modules)
  set(leans)
  set(calls)
  set(assembly "/* The SPIR-V modules, each with its lean ones and their ends. */\n.section .rodata\n")
  list(SORT ARG_SOURCES COMPARE FILE_BASENAME)
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(name ${source} NAME_WE)
    get_filename_component(source ${source} ABSOLUTE)
    set(module ${outFolder}/spirv/${name}.spv)
    set(lean ${outFolder}/spirv/${name}.lean)
    set(placed ${outFolder}/spirv/${name}.placed)
    add_custom_command(
      OUTPUT ${module} ${lean} ${placed}
      COMMAND ${GLSLANG_VALIDATOR} -V --target-env vulkan1.2 --auto-map-bindings --quiet -I${shaderFolder}
              --depfile ${module}.d -o ${module} ${source}
      COMMAND importon_optimise_module ${module} ${module} ${lean} ${placed} ${IMPORTON_KERNEL_CACHE}
      DEPENDS ${source} importon_optimise_module
      DEPFILE ${module}.d
      COMMENT "Kernel ${name}"
      VERBATIM)
    list(APPEND modules ${module})
    list(APPEND leans ${lean} ${placed})
    list(APPEND calls ${outFolder}/include/${namespace}/${name}.h)
    set(symbol ${target}_${name})
    string(APPEND assembly
           ".balign 4\n.global ${symbol}, ${symbol}_end, ${symbol}_lean_end, ${symbol}_placed_end\n"
           "${symbol}:\n.incbin \"${module}\"\n${symbol}_end:\n.incbin \"${lean}\"\n${symbol}_lean_end:\n"
           ".incbin \"${placed}\"\n${symbol}_placed_end:\n")
  endforeach()
  string(APPEND assembly ".section .note.GNU-stack,\"\",%progbits\n")
  file(CONFIGURE OUTPUT ${outFolder}/modules.S CONTENT "${assembly}")

  add_custom_command(
    OUTPUT ${outFolder}/registry.cpp ${outFolder}/include/${namespace}/buffers.h
           ${outFolder}/include/${namespace}/registry.h ${calls}
    COMMAND importon_describe_kernels ${outFolder} ${namespace} ${target} ${shaderFolder}/shared ${modules}
    DEPENDS importon_describe_kernels ${modules}
    COMMENT "Calls of kernels: ${namespace}"
    VERBATIM)
  add_library(${target} STATIC ${outFolder}/registry.cpp ${outFolder}/modules.S)
  set_source_files_properties(${outFolder}/modules.S PROPERTIES OBJECT_DEPENDS "${modules};${leans}")
  target_link_libraries(${target} PUBLIC importon_gpu)
  target_include_directories(${target} PUBLIC ${outFolder}/include)
endfunction()
