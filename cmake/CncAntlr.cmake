# ANTLR: the Debian tool is 4.7.2 and the runtime 4.9; they fit each other. Generated code is C++17 in a target of
# its own, without our warnings, its symbols hidden; the runtime is linked statically, but for the shared library.
find_program(ANTLR4_TOOL antlr4 REQUIRED)
if(CNCTRANS_SHARED) # Debian's archive is not position-independent
  find_library(ANTLR4_RUNTIME antlr4-runtime REQUIRED)
else()
  find_library(ANTLR4_RUNTIME_STATIC libantlr4-runtime.a REQUIRED)
  set(ANTLR4_RUNTIME ${ANTLR4_RUNTIME_STATIC})
endif()
find_path(ANTLR4_INCLUDE antlr4-runtime/antlr4-runtime.h REQUIRED)

set(antlr_headers ${ANTLR4_INCLUDE}/antlr4-runtime)
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
  # Clang finds no default constructor for the runtime's Vocabulary (const vectors without an initialiser; language
  # defect 253, which GCC takes as it was meant). It reads a copy of the headers where they have one.
  set(antlr_headers ${CMAKE_BINARY_DIR}/generated/antlr4-runtime)
  file(COPY ${ANTLR4_INCLUDE}/antlr4-runtime/ DESTINATION ${antlr_headers})
  file(READ ${antlr_headers}/Vocabulary.h vocabulary)
  string(REGEX REPLACE "(const _(literal|symbolic|display)Names);" "\\1{};" vocabulary "${vocabulary}")
  file(WRITE ${antlr_headers}/Vocabulary.h "${vocabulary}")
endif()

add_library(cnc_antlr_runtime INTERFACE)
target_include_directories(cnc_antlr_runtime SYSTEM INTERFACE ${antlr_headers})
find_package(Threads REQUIRED)
target_link_libraries(cnc_antlr_runtime INTERFACE ${ANTLR4_RUNTIME} Threads::Threads)

# cnc_grammar(d): grammars/d/*Lexer.g4 and *Parser.g4 -> library cnc_grammar_d; headers under generated/d/.
function(cnc_grammar dialect)
  file(GLOB lexer CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/grammars/${dialect}/*Lexer.g4)
  file(GLOB parser CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/grammars/${dialect}/*Parser.g4)
  if(NOT lexer OR NOT parser)
    add_library(cnc_grammar_${dialect} INTERFACE)
    return()
  endif()
  get_filename_component(lexer_name ${lexer} NAME_WE)
  get_filename_component(parser_name ${parser} NAME_WE)
  set(out ${CMAKE_BINARY_DIR}/generated/${dialect})
  file(MAKE_DIRECTORY ${out})
  set(lexer_out ${out}/${lexer_name}.cpp ${out}/${lexer_name}.h)
  set(parser_out ${out}/${parser_name}.cpp ${out}/${parser_name}.h ${out}/${parser_name}Visitor.cpp
                 ${out}/${parser_name}Visitor.h ${out}/${parser_name}BaseVisitor.cpp ${out}/${parser_name}BaseVisitor.h)
  add_custom_command(OUTPUT ${lexer_out} ${out}/${lexer_name}.tokens
    COMMAND ${ANTLR4_TOOL} -Dlanguage=Cpp -package cnc_${dialect} -no-listener -Werror -o ${out} ${lexer}
    DEPENDS ${lexer} VERBATIM)
  add_custom_command(OUTPUT ${parser_out}
    COMMAND ${ANTLR4_TOOL} -Dlanguage=Cpp -package cnc_${dialect} -no-listener -visitor -Werror -lib ${out} -o ${out} ${parser}
    DEPENDS ${parser} ${out}/${lexer_name}.tokens VERBATIM)
  add_library(cnc_grammar_${dialect} STATIC ${lexer_out} ${parser_out})
  set_target_properties(cnc_grammar_${dialect} PROPERTIES CXX_STANDARD 17)
  cnc_unity(cnc_grammar_${dialect})
  target_compile_options(cnc_grammar_${dialect} PRIVATE -w)
  # In a debug build the parser is still optimised: it is not ours to debug.
  target_compile_options(cnc_grammar_${dialect} PRIVATE $<$<CONFIG:Debug>:-O1>)
  target_include_directories(cnc_grammar_${dialect} SYSTEM PUBLIC ${CMAKE_BINARY_DIR}/generated)
  target_link_libraries(cnc_grammar_${dialect} PUBLIC cnc_antlr_runtime)
endfunction()
