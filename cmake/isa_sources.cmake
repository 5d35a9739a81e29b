# encore_isa_sources(<target> <sources>): compiles the sources once an instruction set and adds all
# of it to the target. Each time ENCORE_ISA is the name of the namespace that everything in them
# belongs in (accel/simd/intrinsics.h); processors other than x86 get the portable one alone.
#
# Nothing else may be compiled with such options: a function that several files share would be
# linked from any of them (tests/architecture looks at the object files).
function(encore_isa_sources target)
  set(portable_options "")
  if(ENCORE_SANITIZE)
    # Sanitizers' checks in its unrolled loops take the compiler ten minutes a file at -O2.
    set(portable_options -O1 -fno-var-tracking)
  endif()
  set(isas portable)
  if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
    list(APPEND isas sse42 avx2 avx512)
    set(sse42_options -msse4.2)
    set(avx2_options -mavx2 -mbmi -mbmi2 -mlzcnt)
    # Registers of 64 bytes only where the code says so: the compiler's own choice is 32.
    set(avx512_options -mavx512f -mavx512bw -mavx512dq -mavx512vl -mbmi -mbmi2 -mlzcnt)
  endif()
  foreach(isa IN LISTS isas)
    set(object ${target}_${isa})
    if(NOT TARGET ${object})
      add_library(${object} OBJECT)
      target_link_libraries(${object} PRIVATE encore_options)
      target_compile_definitions(${object} PRIVATE ENCORE_ISA=${isa})
      target_compile_options(${object} PRIVATE ${${isa}_options})
      target_include_directories(${object} PRIVATE ${ENCORE_GLM_DIR})
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:${object}>)
    endif()
    target_sources(${object} PRIVATE ${ARGN})
  endforeach()
endfunction()
