#include "module.h"
#include "slipface/level/preset.h"

namespace slipface::python {
namespace {

const SettingInfo& row_of(const std::string& name) {
    const SettingInfo* const info = find_setting(name);
    if (info == nullptr)
        throw py::attribute_error("found no setting \"" + name + "\"; slipface.settings lists them");
    return *info;
}

py::object get(const MovementSettings& settings, const std::string& name) {
    const SettingInfo& info = row_of(name);
    const double value = get_setting(settings, info);
    if (is_switch(info)) return py::bool_(value != 0.0);
    if (is_choice(info)) return py::str(choices_of(info)[static_cast<std::size_t>(value)].name);
    if (std::holds_alternative<int MovementSettings::*>(info.member))
        return py::int_(static_cast<int>(value));
    return py::float_(value);
}

void set(MovementSettings& settings, const std::string& name, const py::object& value) {
    const SettingInfo& info = row_of(name);
    const Status status = py::isinstance<py::str>(value)
                              ? set_setting(settings, name + "=" + value.cast<std::string>())
                              : set_setting(settings, info, value.cast<double>());
    if (!status) raise(status.error());
}

MovementSettings make(const std::optional<std::string>& preset, const py::kwargs& changes) {
    MovementSettings settings;
    if (preset) settings = value_or_raise(find_preset(*preset)).settings;
    for (const auto& [name, value] : changes)
        set(settings, name.cast<std::string>(), py::reinterpret_borrow<py::object>(value));
    return settings;
}

py::list names() {
    py::list list;
    for (const SettingInfo& info : settings_table())
        list.append(info.name);
    return list;
}

}  // namespace

void add_settings(py::module_& module) {
    py::class_<MovementSettings>(
        module, "Settings",
        "Settings of the movement: those of a preset (\"platformer\", \"lecture\", ...) "
        "or of a preset file, with changes by name: Settings(\"lecture\", gravity=12). "
        "Angles are radians, or text as \"50deg\".")
        .def(py::init(&make), py::arg("preset") = py::none())
        .def("__getattr__", &get)
        .def("__setattr__", &set)
        .def("__getitem__", &get)
        .def("__setitem__", &set)
        .def("__eq__", [](const MovementSettings& a, const MovementSettings& b) { return a == b; })
        .def("__copy__", [](const MovementSettings& settings) { return settings; })
        .def("__dir__", [](const MovementSettings&) { return names(); })
        .def("keys", [](const MovementSettings&) { return names(); })
        .def("__repr__", [](const MovementSettings& settings) {
            std::string text = "Settings(";
            for (const SettingInfo& info : settings_table())
                if (get_setting(settings, info) != get_setting(MovementSettings{}, info))
                    text += (text.back() == '(' ? "" : ", ") + std::string(info.name) + "=\"" +
                            setting_text(settings, info) + "\"";
            return text + ")";
        });
    py::dict meanings;
    for (const SettingInfo& info : settings_table())
        meanings[info.name] =
            meaning_of(info) + (*info.unit == '\0' ? "" : " (" + std::string(info.unit) + ")");
    module.attr("settings") = meanings;
}

}  // namespace slipface::python
