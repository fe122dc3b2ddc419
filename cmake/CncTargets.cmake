# Targets of the house: every folder globs its own sources, so that adding a file needs no edit here.

set(CNC_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wold-style-cast
                 -Wimplicit-fallthrough)
if(CNCTRANS_WERROR)
  list(APPEND CNC_WARNINGS -Werror)
endif()

# GCC 12 finds faults in the standard library's own inlined code that are none (bugs 105329, 105562, 105651); they depend on
# the optimiser, so an error would hit whoever builds with other options.
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND CNC_WARNINGS -Wno-restrict -Wno-error=maybe-uninitialized -Wno-error=array-bounds -Wno-error=stringop-overflow
       -Wno-error=stringop-overread -Wno-error=free-nonheap-object -Wno-error=dangling-pointer -Wno-error=nonnull)
endif()

# In a group a file sees the helpers of the files before it; a local variable may be called as one of them.
if(CNCTRANS_UNITY)
  list(APPEND CNC_WARNINGS -Wno-shadow)
  if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
    list(APPEND CNC_WARNINGS -Wshadow=local -Wno-subobject-linkage)
  endif()
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

# cnc_unity(target): the sources of each folder in groups of about eight, each compiled as one. Which group a file is in comes
# from its own name, so that a new file makes one group anew and not all behind it. Helpers of two files in an unnamed
# namespace must not share a name for that (tools/check-names).
function(cnc_unity target)
  if(NOT CNCTRANS_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  set(folders)
  foreach(source IN LISTS sources)
    get_filename_component(folder ${source} DIRECTORY)
    list(APPEND folders ${folder})
    list(APPEND "in_${folder}" ${source})
  endforeach()
  list(REMOVE_DUPLICATES folders)
  foreach(folder IN LISTS folders)
    file(RELATIVE_PATH name ${CMAKE_SOURCE_DIR} ${folder})
    string(MAKE_C_IDENTIFIER "${name}" name)
    list(LENGTH "in_${folder}" count)
    math(EXPR groups "(${count} + 7) / 8")
    foreach(source IN LISTS "in_${folder}")
      get_filename_component(file ${source} NAME)
      string(MD5 sum ${file})
      string(SUBSTRING ${sum} 0 6 digits)
      math(EXPR group "0x${digits} % ${groups}")
      set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${name}_${group})
    endforeach()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# cnc_library(folder LINK targets...): static library cnc_<folder with _> of folder/*.cpp (recursively).
function(cnc_library folder)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  string(REPLACE "/" "_" name ${folder})
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  if(sources)
    add_library(cnc_${name} STATIC ${sources})
    cnc_unity(cnc_${name})
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
    cnc_unity(${name})
    target_link_libraries(${name} PRIVATE cnc_options ${ARG_LINK})
  endif()
endfunction()
