#include "verify/Draw.h"
