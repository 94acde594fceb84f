// Glyphs of Font Awesome 4.7 as UTF-8, for labels drawn with the editor's merged font.
#pragma once

namespace slipface::icons {

inline constexpr const char* folder_open = "\xef\x81\xbc";  // f07c
inline constexpr const char* save = "\xef\x83\x87";         // f0c7
inline constexpr const char* sign_out = "\xef\x82\x8b";     // f08b
inline constexpr const char* undo = "\xef\x83\xa2";         // f0e2
inline constexpr const char* redo = "\xef\x80\x9e";         // f01e
inline constexpr const char* pointer = "\xef\x89\x85";      // f245
inline constexpr const char* brush = "\xef\x87\xbc";        // f1fc
inline constexpr const char* fill = "\xef\x81\x83";         // f043
inline constexpr const char* crosshairs = "\xef\x81\x9b";   // f05b
inline constexpr const char* eyedropper = "\xef\x87\xbb";   // f1fb
inline constexpr const char* eraser = "\xef\x84\xad";       // f12d
inline constexpr const char* plus = "\xef\x81\xa7";         // f067
inline constexpr const char* minus = "\xef\x81\xa8";        // f068
inline constexpr const char* trash = "\xef\x87\xb8";        // f1f8
inline constexpr const char* check = "\xef\x80\x8c";        // f00c
inline constexpr const char* all = "\xef\x89\x87";          // f247
inline constexpr const char* none = "\xef\x82\x96";         // f096
inline constexpr const char* exchange = "\xef\x83\xac";     // f0ec
inline constexpr const char* flag = "\xef\x80\xa4";         // f024
inline constexpr const char* frame = "\xef\x81\xa6";        // f066
inline constexpr const char* frame_all = "\xef\x82\xb2";    // f0b2
inline constexpr const char* picture = "\xef\x80\xbe";      // f03e
inline constexpr const char* layers = "\xef\x89\x8d";       // f24d
inline constexpr const char* grid = "\xef\x80\x8a";         // f00a
inline constexpr const char* cube = "\xef\x86\xb2";         // f1b2
inline constexpr const char* eye = "\xef\x81\xae";          // f06e
inline constexpr const char* sliders = "\xef\x87\x9e";      // f1de
inline constexpr const char* palette = "\xef\x87\xbc";      // f1fc
inline constexpr const char* table = "\xef\x83\x8e";        // f0ce
inline constexpr const char* history = "\xef\x87\x9a";      // f1da
inline constexpr const char* warning = "\xef\x81\xb1";      // f071
inline constexpr const char* info = "\xef\x81\x9a";         // f05a
inline constexpr const char* play = "\xef\x81\x8b";         // f04b
inline constexpr const char* stop = "\xef\x81\x8d";         // f04d
inline constexpr const char* restart = "\xef\x80\xa1";      // f021
inline constexpr const char* person = "\xef\x86\x83";       // f183
inline constexpr const char* keyboard = "\xef\x84\x9c";     // f11c
inline constexpr const char* copy = "\xef\x83\x85";         // f0c5
inline constexpr const char* reset = "\xef\x84\x92";        // f112
inline constexpr const char* dot = "\xef\x84\x91";          // f111

}  // namespace slipface::icons
