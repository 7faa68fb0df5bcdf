# cmake -DNM=<nm> -DLIBRARIES=<library>;… -DALLOWED=<object>:<symbol>;… [-DASSERTIONS=ON]
#   [-DEXPECTED=<symbol>;…] -P check_symbols.cmake
#
# A library never writes to standard output or error and never ends the process. Fails, naming object
# and symbol, on each undefined symbol that could, unless ALLOWED has it. Several sources in one object of
# a unity build are named by that. With EXPECTED (regular expressions) it fails unless each is reported.
#
# An assertion that fails prints and ends the process too. A build without NDEBUG keeps those of Eigen and
# OpenMesh, as whoever builds so wants: ASSERTIONS says that this is one.
cmake_minimum_required(VERSION 3.25)

# Formatting into memory (snprintf) is no output; write() to a file of one's own and posix_spawn() of the
# readers are what files and child processes are made with.
set(forbidden
  # output
  "(__)?(v?f?w?printf|vf?wprintf|v?dprintf)(_chk)?" "(__)?(f?w?printf|v?f?printf)_unlocked" "f?puts(_unlocked)?"
  "f?putw?c(har)?(_unlocked)?" "putw" "fputws(_unlocked)?" "_IO_putc" "perror" "psig(nal|info)" "v?syslog"
  "(__v?syslog_chk)" "v?(warn|err)x?" "error(_at_line)?" "malloc_(stats|info)" "backtrace_symbols_fd"
  "stdout" "stderr" "_ZSt4cout" "_ZSt4cerr" "_ZSt4clog" "_ZSt5wcout" "_ZSt5wcerr" "_ZSt5wclog" "_ZSt.*vprint_.*"
  "_ZN3fmt.*5print.*" "_Z5omoutv" "_Z5omerrv" "_Z5omlogv" "_ZSt4cinE?"
  # the end of the process
  "exit" "_exit" "_Exit" "quick_exit" "abort" "_ZSt9terminatev" "raise" "kill(pg)?" "(pthread_|t|tg)kill" "sigqueue"
  "alarm" "u?alarm" "setitimer" "syscall" "daemon"
  "system" "popen" "wordexp" "f?exec[vl][pe]*" "execveat" "_?v?fork" "_Fork" "clone3?")
if(NOT ASSERTIONS)
  list(APPEND forbidden "__assert(_fail|_perror_fail)?" "_ZN3fmt.*11assert_fail.*")
endif()

set(problems "")
set(count 0)
foreach(library IN LISTS LIBRARIES)
  execute_process(COMMAND ${NM} -A -u -P ${library} OUTPUT_VARIABLE text RESULT_VARIABLE result ERROR_QUIET)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} cannot read ${library}")
  endif()
  string(REPLACE ";" "," text "${text}")
  string(REPLACE "[" "(" text "${text}")
  string(REPLACE "]" ")" text "${text}")
  string(REPLACE "\n" ";" lines "${text}")
  foreach(line IN LISTS lines)
    if(NOT line MATCHES "[(/:]([A-Za-z_0-9]+)(\\.cpp|\\.cxx)\\.o\\)?: ([^ ]+) [Uw]")
      continue()
    endif()
    set(object ${CMAKE_MATCH_1})
    string(REGEX REPLACE "@.*" "" symbol "${CMAKE_MATCH_3}")
    math(EXPR count "${count} + 1")
    foreach(pattern IN LISTS forbidden)
      if(symbol MATCHES "^(${pattern})$" AND NOT "${object}:${symbol}" IN_LIST ALLOWED)
        list(APPEND problems "${object} uses ${symbol}")
      endif()
    endforeach()
  endforeach()
endforeach()
if(count LESS 10)
  message(FATAL_ERROR "${count} undefined symbols in ${LIBRARIES}: this check does not read them")
endif()
list(REMOVE_DUPLICATES problems)
list(JOIN problems "\n  " text)
if(EXPECTED)
  foreach(pattern IN LISTS EXPECTED)
    if(NOT "${text}\n" MATCHES "uses ${pattern}\n")
      message(FATAL_ERROR "${pattern} is not reported:\n  ${text}")
    endif()
  endforeach()
  message(STATUS "all are reported:\n  ${text}")
  return()
endif()
if(problems)
  message(FATAL_ERROR "the library may print or end the process:\n  ${text}")
endif()
message(STATUS "none of ${count} undefined symbols prints or ends the process")
