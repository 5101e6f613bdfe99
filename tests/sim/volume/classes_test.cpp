#include <gtest/gtest.h>
#include "sim/volume/classes.h"
