// SPDX-License-Identifier: GPL-3.0-only
#include "scene/scene.h"

namespace sprag
{
  Scene::Scene()                             = default;
  Scene::Scene(const Scene &)                = default;
  Scene::Scene(Scene &&) noexcept            = default;
  Scene &Scene::operator=(const Scene &)     = default;
  Scene &Scene::operator=(Scene &&) noexcept = default;
  Scene::~Scene()                            = default;
} // namespace sprag
