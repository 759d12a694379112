# Fragments are run as scripts on the kernel's double.
dotek_embed_text(backends/fusion/Kernel.js ${PROJECT_BINARY_DIR}/generated/FusionKernel.cpp
                 backends/fusion/KernelText.h dotek::backends::fusion kernelText)
target_sources(dotek_backends_fusion PRIVATE ${PROJECT_BINARY_DIR}/generated/FusionKernel.cpp)
target_link_libraries(dotek_backends_fusion PUBLIC dotek_script)
