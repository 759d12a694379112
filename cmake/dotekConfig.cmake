# find_package(dotek): the target dotek::dotek.
include(CMakeFindDependencyMacro)
list(PREPEND CMAKE_MODULE_PATH ${CMAKE_CURRENT_LIST_DIR})
find_dependency(fmt)
find_dependency(Antlr4Runtime)
find_dependency(Duktape)
find_dependency(Md)
list(POP_FRONT CMAKE_MODULE_PATH)
include(${CMAKE_CURRENT_LIST_DIR}/dotekTargets.cmake)
