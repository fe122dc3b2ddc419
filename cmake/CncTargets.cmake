# Targets of the house: every folder globs its own sources, so that adding a file needs no edit here.

set(CNC_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
                 -Wimplicit-fallthrough -Werror)

# GCC 12 finds faults in the standard library's own inlined code that are none (bugs 105329, 105562, 105651); they depend on
# the optimiser, so an error would hit whoever builds with other options.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND CNC_WARNINGS -Wno-restrict -Wno-error=maybe-uninitialized -Wno-error=array-bounds -Wno-error=stringop-overflow
       -Wno-error=stringop-overread -Wno-error=free-nonheap-object -Wno-error=dangling-pointer -Wno-error=nonnull)
endif()

add_library(cnc_options INTERFACE)
target_include_directories(cnc_options INTERFACE ${CMAKE_SOURCE_DIR} ${CMAKE_SOURCE_DIR}/include)
target_compile_options(cnc_options INTERFACE ${CNC_WARNINGS})
if(CNCTRANS_SANITIZE OR CMAKE_BUILD_TYPE STREQUAL "Debug")
  add_compile_definitions(_GLIBCXX_ASSERTIONS) # indices out of range stop the program
endif()
if(CNCTRANS_SANITIZE)
  add_compile_options(-fsanitize=address,undefined -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
endif()

# cnc_library(folder [EXCLUDE regex] LINK targets...): static library cnc_<folder with _> of folder/*.cpp (recursively).
function(cnc_library folder)
  cmake_parse_arguments(ARG "" "EXCLUDE" "LINK" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(ARG_EXCLUDE)
    list(FILTER sources EXCLUDE REGEX ${ARG_EXCLUDE})
  endif()
  if(sources)
    add_library(cnc_${name} STATIC ${sources})
  else()
    add_library(cnc_${name} INTERFACE)
  endif()
  cnc_link(cnc_${name} cnc_options ${ARG_LINK})
endfunction()

# cnc_link(target libraries...): what the users of a floor link too; a folder without sources is an interface library.
function(cnc_link target)
  get_target_property(type ${target} TYPE)
  if(type STREQUAL INTERFACE_LIBRARY)
    target_link_libraries(${target} INTERFACE ${ARGN})
  else()
    target_link_libraries(${target} PUBLIC ${ARGN})
  endif()
endfunction()

function(cnc_executable folder name)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(sources)
    add_executable(${name} ${sources})
    target_link_libraries(${name} PRIVATE cnc_options ${ARG_LINK})
  endif()
endfunction()
