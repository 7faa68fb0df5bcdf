# dsc_private_headers(<folder of the layers> <variable>): the headers under it, relative to it, that are
# their layer's own: `/// \internal` is their second line. Every other header of a library's layer is public.
function(dsc_private_headers root result)
  set(private "")
  file(GLOB_RECURSE headers RELATIVE ${root} ${root}/*.h)
  foreach(header IN LISTS headers)
    file(STRINGS ${root}/${header} line LIMIT_COUNT 2 REGEX "^/// \\\\internal$")
    if(line)
      list(APPEND private ${header})
    endif()
  endforeach()
  set(${result} ${private} PARENT_SCOPE)
endfunction()
