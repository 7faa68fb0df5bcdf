#include "libdsc/render/stroke_font.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

namespace dsc::render {
namespace {

/// A character's strokes, parted by ';'. A stroke runs through its points "x,y" and along its arcs
/// "@x,y,rx,ry,from,to": round the centre, angles in degrees, 0 to the right, 90 up.
struct Letter {
  char sign;
  const char* strokes;
};

constexpr Letter kLetters[] = {
    {'0', "@2,3.5,2,3.5,0,360"},
    {'1', "0.6,5.6 2.3,7 2.3,0"},
    {'2', "@2,5,2,2,165,-38 0,0 4,0"},
    {'3', "@1.9,5.3,1.75,1.7,150,-90;@1.9,1.8,2,1.8,90,-150"},
    {'4', "3.1,0 3.1,7 0,2 4.2,2"},
    {'5', "3.7,7 0.7,7 0.4,3.9 @1.9,2.3,2.1,2.3,130,-145"},
    {'6', "3,7 0.35,3.3 @2,2.15,2,2.15,150,510"},
    {'7', "0,7 4,7 1.4,0"},
    {'8', "@2,5.3,1.7,1.7,-90,270;@2,1.8,2,1.8,90,450"},
    {'9', "1,0 3.65,3.7 @2,4.85,2,2.15,-30,330"},
    {'A', "0,0 2.4,7 4.8,0;0.8,2.3 4,2.3"},
    {'B', "0,0 0,7 2,7 @2,5.35,1.7,1.65,90,-90 0,3.7;2,3.7 @2.1,1.85,2,1.85,90,-90 0,0"},
    {'C', "@2.7,3.5,2.7,3.5,45,315"},
    {'D', "0,0 0,7 1.6,7 @1.6,3.5,3,3.5,90,-90 0,0"},
    {'E', "4,7 0,7 0,0 4,0;0,3.7 3.4,3.7"},
    {'F', "4,7 0,7 0,0;0,3.7 3.2,3.7"},
    {'G', "@2.7,3.5,2.7,3.5,45,360 3.2,3.5"},
    {'H', "0,0 0,7;4.4,0 4.4,7;0,3.7 4.4,3.7"},
    {'I', "0.2,0 0.2,7"},
    {'J', "2.8,7 2.8,1.8 @1.4,1.8,1.4,1.8,0,-160"},
    {'K', "0,0 0,7;4,7 0,2.6;1.5,4.2 4.2,0"},
    {'L', "0,7 0,0 3.6,0"},
    {'M', "0,0 0,7 2.7,2 5.4,7 5.4,0"},
    {'N', "0,0 0,7 4.4,0 4.4,7"},
    {'O', "@2.7,3.5,2.7,3.5,0,360"},
    {'P', "0,0 0,7 2.2,7 @2.2,5.1,1.9,1.9,90,-90 0,3.2"},
    {'Q', "@2.7,3.5,2.7,3.5,0,360;3.4,1.6 5.3,-0.5"},
    {'R', "0,0 0,7 2.2,7 @2.2,5.1,1.9,1.9,90,-90 0,3.2;2.2,3.2 4.2,0"},
    {'S', "@2.1,5.3,1.9,1.7,40,270;@2.1,1.8,2.1,1.8,90,-140"},
    {'T', "0,7 4.6,7;2.3,7 2.3,0"},
    {'U', "0,7 0,2.2 @2.2,2.2,2.2,2.2,180,360 4.4,7"},
    {'V', "0,7 2.4,0 4.8,7"},
    {'W', "0,7 1.6,0 3.2,7 4.8,0 6.4,7"},
    {'X', "0,0 4.4,7;0,7 4.4,0"},
    {'Y', "0,7 2.3,3.4 4.6,7;2.3,3.4 2.3,0"},
    {'Z', "0,7 4.4,7 0,0 4.6,0"},
    {'a', "@2,2.5,2,2.5,0,360;4,5 4,0"},
    {'b', "0,7.3 0,0;@2,2.5,2,2.5,0,360"},
    {'c', "@2.1,2.5,2.1,2.5,48,312"},
    {'d', "4,7.3 4,0;@2,2.5,2,2.5,0,360"},
    {'e', "0,2.5 4,2.5 @2,2.5,2,2.5,0,318"},
    {'f', "@2.3,6.1,1.2,1.2,50,180 1.1,0;0,5 2.6,5"},
    {'g', "4,5 4,-0.2 @2,-0.2,2,1.8,0,-150;@2,2.5,2,2.5,0,360"},
    {'h', "0,7.3 0,0;0,3 @1.85,3,1.85,2,180,0 3.7,0"},
    {'i', "0.2,5 0.2,0;0.2,7 0.2,7.05"},
    {'j', "1.1,5 1.1,-0.8 @0,-0.8,1.1,1.2,0,-90;1.1,7 1.1,7.05"},
    {'k', "0,7.3 0,0;3.3,5 0,1.9;1.2,3 3.6,0"},
    {'l', "0.2,7.3 0.2,0"},
    {'m', "0,5 0,0;0,3.3 @1.6,3.3,1.6,1.7,180,0 3.2,0;3.2,3.3 @4.8,3.3,1.6,1.7,180,0 6.4,0"},
    {'n', "0,5 0,0;0,3 @1.85,3,1.85,2,180,0 3.7,0"},
    {'o', "@2,2.5,2,2.5,0,360"},
    {'p', "0,5 0,-2;@2,2.5,2,2.5,0,360"},
    {'q', "4,5 4,-2;@2,2.5,2,2.5,0,360"},
    {'r', "0,5 0,0;0,3 @1.9,3,1.9,2,180,70"},
    {'s', "@1.7,3.75,1.55,1.25,40,270;@1.7,1.25,1.7,1.25,90,-145"},
    {'t', "1.1,6.7 1.1,1.3 @2.3,1.3,1.2,1.3,180,285;0,5 2.6,5"},
    {'u', "0,5 0,2 @1.85,2,1.85,2,180,360;3.7,5 3.7,0"},
    {'v', "0,5 1.9,0 3.8,5"},
    {'w', "0,5 1.4,0 2.8,5 4.2,0 5.6,5"},
    {'x', "0,5 3.6,0;3.6,5 0,0"},
    {'y', "0,5 1.95,0;3.8,5 1.1,-2"},
    {'z', "0.1,5 3.5,5 0,0 3.6,0"},
    {'.', "0.2,0 0.2,0.05"},
    {',', "0.6,0.2 0.1,-1.2"},
    {':', "0.2,0 0.2,0.05;0.2,4 0.2,4.05"},
    {'-', "0.2,3.1 3.2,3.1"},
    {'+', "0.2,3.1 3.6,3.1;1.9,1.4 1.9,4.8"},
    {'=', "0.2,2.2 3.4,2.2;0.2,4 3.4,4"},
    {'_', "0,-0.9 3.4,-0.9"},
    {'|', "0.2,7.6 0.2,-1.6"},
    {'/', "0,-1 3,7.3"},
    {'(', "@3.4,3,3.2,5,112,248"},
    {')', "@-1.2,3,3.2,5,68,-68"},
};
constexpr const char* kBox = "0,0 3.6,0 3.6,7 0,7 0,0";
constexpr double kBlank = 3;
constexpr double kGap = 1.9;  // between characters, the strokes' own width in it

/// The numbers of "1,2.5,-3".
std::vector<double> numbers(const std::string& text) {
  std::vector<double> all;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double value = 0;
  for (char comma = 0; stream >> value; stream >> comma) all.push_back(value);
  return all;
}

/// Adds the strokes, moved right by x; returns how far they reach from there.
double add(const char* strokes, double x, std::vector<Segment>& to) {
  double width = 0;
  std::istringstream all(strokes);
  for (std::string stroke; std::getline(all, stroke, ';');) {
    std::vector<Eigen::Vector2d> line;
    std::istringstream words(stroke);
    for (std::string word; words >> word;) {
      const bool arc = word[0] == '@';
      const std::vector<double> n = numbers(arc ? word.substr(1) : word);
      const int steps = arc ? std::max(4, static_cast<int>(std::abs(n[5] - n[4]) / 12)) : 0;
      for (int i = 0; i <= steps; ++i) {
        if (!arc) {
          line.emplace_back(n[0], n[1]);
          continue;
        }
        const double angle = (n[4] + (n[5] - n[4]) * i / steps) * std::numbers::pi / 180;
        line.emplace_back(n[0] + n[2] * std::cos(angle), n[1] + n[3] * std::sin(angle));
      }
    }
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      const Eigen::Vector2d right(x, 0);
      to.emplace_back(line[i] + right, line[i + 1] + right);
    }
    for (const Eigen::Vector2d& point : line) width = std::max(width, point[0]);
  }
  return width;
}

}  // namespace

StrokedText stroked(const std::string& text) {
  StrokedText result;
  double x = 0;
  for (const char sign : text) {
    double width = kBlank;
    if (sign != ' ') {
      const auto* letter = std::find_if(std::begin(kLetters), std::end(kLetters),
                                        [&](const Letter& l) { return l.sign == sign; });
      width = add(letter == std::end(kLetters) ? kBox : letter->strokes, x, result.segments);
    }
    result.width = x + width;
    x += width + kGap;
  }
  return result;
}

}  // namespace dsc::render
