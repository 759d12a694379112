// What nearly every test includes, precompiled.
#pragma once

#include "driver/Driver.h"

#include <doctest/doctest.h>
