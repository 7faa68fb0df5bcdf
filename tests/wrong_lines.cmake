# What the tests of checks share: a check is only worth something if it fails, on every line marked
# `// wrong` and on no other.

# Runs the command ARGN, which has to fail; its messages in the variable `output`.
macro(expect_failure what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result ERROR_VARIABLE output OUTPUT_VARIABLE output)
  if(result EQUAL 0)
    message(FATAL_ERROR "the check passed ${what}")
  endif()
endmacro()

# Calls is_reported(<file> <number> <line> <result>) on each line below `root` marked `// wrong`, adds
# the number of such lines to `expected`, and fails where one is not reported.
macro(expect_wrong_lines root)
  file(GLOB_RECURSE files RELATIVE ${root} ${root}/*)
  foreach(file IN LISTS files)
    file(STRINGS ${root}/${file} lines)
    set(number 0)
    foreach(line IN LISTS lines)
      math(EXPR number "${number} + 1")
      if(line MATCHES "// wrong$")
        math(EXPR expected "${expected} + 1")
        is_reported("${file}" "${number}" "${line}" reported)
        if(NOT reported)
          message(SEND_ERROR "not reported: ${file}:${number}: ${line}")
        endif()
      endif()
    endforeach()
  endforeach()
endmacro()

# Fails where `pattern` does not stand in `output` once for each of the `expected`.
macro(expect_no_other pattern)
  string(REGEX MATCHALL "${pattern}" reports "${output}")
  list(LENGTH reports count)
  if(NOT count EQUAL expected)
    message(SEND_ERROR "${count} reports for ${expected} mistakes: ${output}")
  endif()
endmacro()
