#include "verify/DrawnPath.h"
