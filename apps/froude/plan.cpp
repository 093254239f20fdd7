#include "answers/answers.hpp"
#include "froude/commands.hpp"
#include "froude/report.hpp"

namespace froude {
namespace {

Report report_of(const Plan& plan) {
  Report out;
  for (const Plan::Section& s : plan.sections) {
    Report section;
    section.say("{}", fact("title", s.title)).keep("lines", Json::array());
    for (const PlanLine& l : s.lines)
      section.row("lines", "  {} {:<18} {}{}", fact("runs", l.runs, l.runs ? "+" : "-"), fact("effect", l.effect),
                  fact("method", l.method), fact("size", l.size, l.size.empty() ? "" : "; " + l.size));
    out.one_of("sections", section);
  }
  return out.sentences("notes", "note: {}", plan.notes);
}

}  // namespace

void plan(const SceneArguments& arguments, const Console& console) {
  tell(report_of(plan(scene::read(arguments.scene))), console);
}

}  // namespace froude
