# Fragments are run in Duktape on the kernel's double.
dotek_embed_text(backends/fusion/Kernel.js ${CMAKE_BINARY_DIR}/generated/FusionKernel.cpp
                 backends/fusion/KernelText.h dotek::backends::fusion kernelText)
target_sources(dotek_backends_fusion PRIVATE ${CMAKE_BINARY_DIR}/generated/FusionKernel.cpp)
target_link_libraries(dotek_backends_fusion PRIVATE ${DUKTAPE_LIBRARY})
target_include_directories(dotek_backends_fusion SYSTEM PRIVATE ${DUKTAPE_INCLUDE_DIR})
