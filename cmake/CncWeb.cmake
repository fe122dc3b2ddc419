# The program as WebAssembly, under emscripten (web/build). What Debian has as libraries for this machine comes from headers and
# sources, in the folder CNCTRANS_WEB_SOURCES, which web/build fills: include/, antlr4/ and clipper/.
set(web_include ${CNCTRANS_WEB_SOURCES}/include)
foreach(target fmt::fmt nlohmann_json::nlohmann_json CLI11::CLI11 FastFloat::fast_float)
  add_library(${target} INTERFACE IMPORTED)
  set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${web_include})
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
# Native exceptions of WebAssembly; std::to_chars of a double is missing in the library of Debian 12's emscripten.
add_compile_options(-fwasm-exceptions "SHELL:-isystem ${CMAKE_SOURCE_DIR}/web/include" -Wno-unknown-warning-option)
add_link_options(-fwasm-exceptions)

file(GLOB_RECURSE antlr_sources ${CNCTRANS_WEB_SOURCES}/antlr4/runtime/src/*.cpp)
add_library(web_antlr STATIC ${antlr_sources})
target_include_directories(web_antlr PRIVATE ${CNCTRANS_WEB_SOURCES}/antlr4/runtime/src)
set_target_properties(web_antlr PROPERTIES CXX_STANDARD 14) # as Debian compiles it: its headers and sources differ for C++17
target_compile_options(web_antlr PRIVATE -w)
set(ANTLR4_RUNTIME_STATIC web_antlr)
set(ANTLR4_INCLUDE ${web_include})

add_library(web_clipper STATIC ${CNCTRANS_WEB_SOURCES}/clipper/clipper.cpp)
set(CNCTRANS_POLYCLIPPING web_clipper)
set(CNCTRANS_POLYCLIPPING_INCLUDE ${web_include})

# cnc_web_links(): the program for a page, its worker and node; files are in memory, and in node also those of the machine. Optimised are the
# objects: to do it again to the whole module takes minutes and gains a tenth of its size.
function(cnc_web_links)
  target_link_options(cnctrans PRIVATE -O1 -sALLOW_MEMORY_GROWTH=1 -sINITIAL_MEMORY=67108864 -sTOTAL_STACK=8388608 -sEXIT_RUNTIME=1
    -sINVOKE_RUN=0 -sMODULARIZE=1 -sEXPORT_NAME=createCnctrans -sEXPORTED_RUNTIME_METHODS=['callMain','FS'] -sFORCE_FILESYSTEM=1
    -lnodefs.js -sNODEJS_CATCH_EXIT=0 -sNODEJS_CATCH_REJECTION=0 -sENVIRONMENT=web,worker,node)
endfunction()
