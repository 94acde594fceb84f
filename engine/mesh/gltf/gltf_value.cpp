#include "gltf/gltf_value.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "obj/obj_text.h"

namespace slipface {

GltfValue GltfValue::operator[](std::string_view key) const {
    const std::string place = fmt::format("{}/{}", place_, key);
    if (value_ == nullptr || !value_->is_object()) return {nullptr, place};
    const auto found = value_->find(std::string(key));
    return {found == value_->end() ? nullptr : &*found, place};
}

std::size_t GltfValue::size() const {
    if (value_ == nullptr) return 0;
    if (!value_->is_array()) refuse(fmt::format("found {}; expected an array", found()));
    return value_->size();
}

GltfValue GltfValue::at(std::size_t index) const {
    if (index >= size()) refuse(fmt::format("index {} is out of range; there are {}", index, size()));
    return {&(*value_)[index], fmt::format("{}/{}", place_, index)};
}

std::string GltfValue::text(std::optional<std::string> otherwise) const {
    if (value_ == nullptr && otherwise) return *otherwise;
    if (!is_text()) refuse(fmt::format("found {}; expected text", found()));
    bool converted = false;
    return utf8_name(value_->get_ref<const std::string&>(), converted);
}

double GltfValue::number(std::optional<double> otherwise) const {
    if (value_ == nullptr && otherwise) return *otherwise;
    if (value_ == nullptr || !value_->is_number() || !std::isfinite(value_->get<double>()))
        refuse(fmt::format("found {}; expected a number", found()));
    return value_->get<double>();
}

std::uint64_t GltfValue::whole(std::optional<std::uint64_t> otherwise) const {
    if (value_ == nullptr && otherwise) return *otherwise;
    const double value = number();
    constexpr double largest = 9007199254740992.0;  // 2^53: beyond it not every whole number is a double
    if (value < 0.0 || value > largest || value != std::floor(value))
        refuse(fmt::format("found {}; expected a whole number from 0", found()));
    return static_cast<std::uint64_t>(value);
}

bool GltfValue::truth(bool otherwise) const {
    if (value_ == nullptr) return otherwise;
    if (!is_truth()) refuse(fmt::format("found {}; expected true or false", found()));
    return value_->get<bool>();
}

void GltfValue::numbers(float* out, std::size_t count) const {
    if (value_ == nullptr) return;
    if (size() != count) refuse(fmt::format("found {} numbers; expected {}", size(), count));
    for (std::size_t i = 0; i < count; ++i) {
        const auto value = static_cast<float>(at(i).number());
        if (!std::isfinite(value))
            at(i).refuse(fmt::format("found {}; expected a number of 32 bits", found()));
        out[i] = value;
    }
}

bool GltfValue::is_text() const {
    return value_ != nullptr && value_->is_string();
}

bool GltfValue::is_truth() const {
    return value_ != nullptr && value_->is_boolean();
}

std::string GltfValue::json() const {
    return value_ == nullptr ? std::string()
                             : value_->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string GltfValue::found() const {
    if (value_ == nullptr) return "nothing";
    if (value_->is_array() || value_->is_object()) return fmt::format("an {}", value_->type_name());
    return in_quotes(json());
}

}  // namespace slipface
