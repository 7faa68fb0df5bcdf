# cmake -DROOT=<source tree> -DOUTPUT=<file.svg> [-DCHECK=ON] -P draw_layers.cmake
#
# Draws the picture of the layers: their names as tests/layers checks them, their words from the table of
# README.md, which must list them in the same order. With CHECK, compares OUTPUT with what would be drawn.
cmake_minimum_required(VERSION 3.25)

file(STRINGS ${ROOT}/tests/layers/check_layers.cmake line REGEX "^set\\(layers ")
string(REGEX REPLACE "^set\\(layers (.*)\\)$" "\\1" layers "${line}")
string(REPLACE " " ";" layers "${layers}")

# Semicolons would cut CMake's lists.
file(READ ${ROOT}/README.md readme)
string(REPLACE ";" "," readme "${readme}")
string(REGEX MATCHALL "\n\\| `[a-z]+` \\| [^\n]* \\|" rows "${readme}")
set(listed "")
foreach(row IN LISTS rows)
  string(REGEX MATCH "`([a-z]+)` \\| (.*) \\|$" row "${row}")
  list(APPEND listed ${CMAKE_MATCH_1})
  set(words_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()
if(NOT listed STREQUAL layers)
  message(FATAL_ERROR "README.md lists the layers ${listed}; tests/layers/check_layers.cmake checks ${layers}")
endif()

# A row of two lines a layer, each wrapped at a number of characters.
set(wrap 88)
set(y 8)
set(boxes "")
foreach(layer IN LISTS layers)
  string(REGEX REPLACE "[`*]" "" words "${words_${layer}}")
  string(REPLACE "&" "&amp;" words "${words}")
  string(REPLACE " " ";" words "${words}")
  set(lines "")
  set(line "")
  foreach(word IN LISTS words)
    string(LENGTH "${line} ${word}" length)
    if(length GREATER wrap)
      list(APPEND lines "${line}")
      set(line "${word}")
    else()
      string(STRIP "${line} ${word}" line)
    endif()
  endforeach()
  list(APPEND lines "${line}")
  list(LENGTH lines count)
  math(EXPR height "18 * ${count} + 20")
  math(EXPR middle "${y} + ${height} / 2 + 5")
  string(APPEND boxes
    "  <rect x='8' y='${y}' width='784' height='${height}' rx='6'/>\n"
    "  <text class='name' x='24' y='${middle}'>${layer}</text>\n")
  math(EXPR at "${y} + 23")
  foreach(line IN LISTS lines)
    string(APPEND boxes "  <text x='140' y='${at}'>${line}</text>\n")
    math(EXPR at "${at} + 18")
  endforeach()
  math(EXPR y "${y} + ${height} + 8")
endforeach()
math(EXPR bottom "${y} - 16")
math(EXPR height "${y} + 30")
math(EXPR legend "${y} + 16")
set(picture "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 840 ${height}' font-family='sans-serif' font-size='14'>
  <!-- Made by docs/draw_layers.cmake, compared by the test layers.ThePictureIsOfTheLayersChecked. -->
  <style>
    rect { fill: #eef2f8; stroke: #51658a; } text { fill: #1d2a3f; } .name { font-weight: bold; }
    path { fill: none; stroke: #51658a; stroke-width: 2; }
  </style>
  <rect x='0' y='0' width='840' height='${height}' style='fill: #fff; stroke: none'/>
${boxes}  <path d='M 816 ${bottom} V 16 M 808 28 L 816 14 L 824 28'/>
  <text x='8' y='${legend}'>A layer uses itself and what stands above it.</text>
</svg>
")

if(CHECK)
  file(READ ${OUTPUT} drawn)
  if(NOT drawn STREQUAL picture)
    message(FATAL_ERROR "${OUTPUT} shows other layers than README.md and tests/layers have; draw it anew:\n"
                        "cmake -DROOT=. -DOUTPUT=docs/layers.svg -P docs/draw_layers.cmake")
  endif()
else()
  file(WRITE ${OUTPUT} "${picture}")
endif()
