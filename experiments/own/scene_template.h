// The file that `irk new scene` writes: experiments/own/scene.cpp.template, embedded when the build is configured.
#pragma once

#include <string_view>

namespace irk::own {

extern const std::string_view kSceneTemplate;

}  // namespace irk::own
