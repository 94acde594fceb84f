// Rows of "label, control, reset", and drags that undo reverts in one step.
#pragma once

#include <string>

#include "tools/editor.h"

namespace slipface {

// Ends the step of a drag or of typing once nothing is held. Every panel calls it first.
void settle_live_edit(Editor& editor);
// Call this before a widget that changes the document repeatedly while it is held.
void live_edit(Editor& editor, const std::string& step_name);

// A table of such rows in the current window. The labels are as wide as `label_width`, unless the controls
// would have less than `control_em` font sizes. False: not visible.
bool begin_property_rows(const char* id, float label_width, float control_em = 7.5f);
void end_property_rows();
float label_width_of(const char* label);

// Starts a row with its label and moves to the control's cell. `modified` shows a dot before the label.
void property_row(const char* label, const char* tooltip, bool modified = false, float indent = 0.0f);
// The row's last cell: a button that resets the value to its default, shown only if they differ.
bool reset_cell(const char* label, bool modified);

// A number shown in `unit` ("deg" for radians as stored). Wide ranges get a logarithmic slider. True while it
// changes.
bool number_slider(const char* label, double* value, double minimum, double maximum, const char* unit,
                   const char* tooltip, bool whole = false);

// A stored number as shown to users: "12.5 m/s", "50°".
std::string number_text(double value, const char* unit);
// "0 to 100 m/s²", "0° to 89°".
std::string range_text(double minimum, double maximum, const char* unit);
// Upper case for a row's label: "iterative" becomes "Iterative".
std::string sentence_case(std::string text);

// A button to the section of docs/symptoms.md with this title.
void symptom_button(Editor& editor, const char* title);

// A name at the left and a wrapped value next to it. Facts that are listed together take the same `column`,
// that of their longest name (fact_column), so that their values are aligned.
void fact(const char* name, const std::string& value, float column = 0.0f);
float fact_column(const char* longest_name);

}  // namespace slipface
