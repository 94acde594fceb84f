// Rows of "label, control, reset" that panels are made of, and drags that undo takes back in one step.
#pragma once

#include <string>

#include "tools/editor.h"

namespace slipface {

// Ends the step of a drag or of typing once nothing is held any more. Every panel begins with it.
void settle_live_edit(Editor& editor);
// Call before changing the document from a widget that changes it again and again while it is held.
void live_edit(Editor& editor, const std::string& step_name);

// A table of such rows in the current window; `longest_label` sets the width of the labels. False: not
// visible.
bool begin_property_rows(const char* id, float label_width);
void end_property_rows();
float label_width_of(const char* label);

// Starts a row with its label and moves to the control's cell. `modified` shows a dot before the label.
void property_row(const char* label, const char* tooltip, bool modified = false, float indent = 0.0f);
// The row's last cell: a button that takes the value back to its default, shown only where it would change
// something.
bool reset_cell(const char* label, bool modified);

// A number shown in `unit` ("deg" for radians as stored). Wide ranges get a logarithmic slider. True while it
// changes.
bool number_slider(const char* label, double* value, double minimum, double maximum, const char* unit,
                   const char* tooltip, bool whole = false);

// "12.5 m/s", "50°": a stored number as people read it.
std::string number_text(double value, const char* unit);
// "0 to 100 m/s²", "0° to 89°".
std::string range_text(double minimum, double maximum, const char* unit);
// Upper case for a row's label: "iterative" becomes "Iterative".
std::string sentence_case(std::string text);

// A name at the left and a value, wrapped, beside it.
void fact(const char* name, const std::string& value);

}  // namespace slipface
