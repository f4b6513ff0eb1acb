#include "libprt/project/stages.h"
namespace prt { const std::vector<Stage>& stages(){ static const std::vector<Stage> s; return s; } }
