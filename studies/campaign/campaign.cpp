#include "studies/study.h"
namespace studies {
void campaign(const StudyOptions&) {}
}  // namespace studies
