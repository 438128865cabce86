# importon_add_kernels(TARGET NAMESPACE SOURCES FILES...)
#
# Compiles compute shaders to SPIR-V, optimises and validates them (a module that spirv-val rejects breaks the build), and
# embeds them in the static library TARGET with a typed call for each: NAME.comp is called by
# importon::NAMESPACE::Name of <NAMESPACE/name.h> (src/gpu/describe_kernels.cpp). <NAMESPACE/registry.h> has all by name.
# Buffers need no binding: glslang numbers those that have none.
# Includes are found from the shaders folder. glslangValidator writes a dependency file per shader, so an edit
# rebuilds what includes the edited file and nothing else.

find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_OPT spirv-opt REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# A driver specialises a module whenever a program starts, and most do it after inlining all functions: here that is
# done once, and what is left is small. No pass that rewrites arithmetic (--simplify-instructions): see
# docs/experiments/start-up.md.
set(SPIRV_OPT_PASSES
    --merge-return --inline-entry-points-exhaustive --eliminate-dead-functions --eliminate-dead-code-aggressive
    # Variables of functions become values.
    --private-to-local --eliminate-local-single-block --eliminate-local-single-store --eliminate-dead-code-aggressive
    --scalar-replacement=100 --convert-local-access-chains --eliminate-local-single-block
    --eliminate-local-single-store --eliminate-dead-code-aggressive --ssa-rewrite --eliminate-dead-code-aggressive
    # What is constant, unused or computed twice goes.
    --ccp --eliminate-dead-code-aggressive --eliminate-dead-branches --redundancy-elimination --combine-access-chains
    --vector-dce --eliminate-dead-inserts --merge-blocks)

function(importon_add_kernels target namespace)
  cmake_parse_arguments(PARSE_ARGV 2 ARG "" "" "SOURCES")
  get_filename_component(shaderFolder ${CMAKE_CURRENT_FUNCTION_LIST_DIR}/../shaders ABSOLUTE)
  set(outFolder ${CMAKE_CURRENT_BINARY_DIR}/${target}.generated)
  file(MAKE_DIRECTORY ${outFolder}/spirv)

  set(modules)
  set(calls)
  set(assembly "/* The SPIR-V modules, each with its end. */\n.section .rodata\n")
  list(SORT ARG_SOURCES COMPARE FILE_BASENAME)
  foreach(source IN LISTS ARG_SOURCES)
    get_filename_component(name ${source} NAME_WE)
    get_filename_component(source ${source} ABSOLUTE)
    set(module ${outFolder}/spirv/${name}.spv)
    add_custom_command(
      OUTPUT ${module}
      COMMAND ${GLSLANG_VALIDATOR} -V --target-env vulkan1.2 --auto-map-bindings --quiet -I${shaderFolder}
              --depfile ${module}.d -o ${module} ${source}
      COMMAND ${SPIRV_OPT} ${SPIRV_OPT_PASSES} --target-env=vulkan1.2 --scalar-block-layout ${module} -o ${module}
      COMMAND ${SPIRV_VAL} --target-env vulkan1.2 --scalar-block-layout ${module}
      DEPENDS ${source}
      DEPFILE ${module}.d
      COMMENT "Kernel ${name}"
      VERBATIM)
    list(APPEND modules ${module})
    list(APPEND calls ${outFolder}/include/${namespace}/${name}.h)
    set(symbol ${target}_${name})
    string(APPEND assembly
           ".balign 4\n.global ${symbol}, ${symbol}_end\n${symbol}:\n.incbin \"${module}\"\n${symbol}_end:\n")
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
  set_source_files_properties(${outFolder}/modules.S PROPERTIES OBJECT_DEPENDS "${modules}")
  target_link_libraries(${target} PUBLIC importon_gpu)
  target_include_directories(${target} PUBLIC ${outFolder}/include)
endfunction()
