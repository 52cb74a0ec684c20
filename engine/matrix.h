/* Matrices are base's: scenes place their sensors with them, too. */
#ifndef PLR_ENGINE_MATRIX_H
#define PLR_ENGINE_MATRIX_H

#include "base/matrix.h"

#endif
