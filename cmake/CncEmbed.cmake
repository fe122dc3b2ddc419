# cnc_embed_texts(target symbol header files...): the bytes of text files as a table in the target's own library:
#   const EmbeddedText <symbol>[]; const std::size_t <symbol>_count;   (declared in `header`)
function(cnc_embed_texts target symbol header)
  set(out ${CMAKE_BINARY_DIR}/generated/embedded/${symbol}.cpp)
  add_custom_command(OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DSYMBOL=${symbol} -DHEADER=${header} "-DFILES=${ARGN}"
            -P ${CMAKE_SOURCE_DIR}/cmake/embed_texts.cmake
    DEPENDS ${ARGN} ${CMAKE_SOURCE_DIR}/cmake/embed_texts.cmake VERBATIM)
  target_sources(${target} PRIVATE ${out})
endfunction()
