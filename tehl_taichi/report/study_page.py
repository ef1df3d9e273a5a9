"""Page of a study: its results over the swept keys, the table, failed cases."""

from dataclasses import replace

import numpy as np

from tehl_taichi.fatigue.judged_layers import ABOVE, WITHIN, judged
from tehl_taichi.report.document import Answer, Page, Section, facts, figure_block, sentences, table
from tehl_taichi.report.number_text import sentence_case, value_text
from tehl_taichi.report.run_page import scene_section
from tehl_taichi.report.study_plots import figures
from tehl_taichi.report.verdict import limit_words
from tehl_taichi.runs.sweep import study_figures
from tehl_taichi.runs.sweep.main_effects import usual_effects
from tehl_taichi.runs.sweep.study_labels import column_name, key_name, label_with_value, name_and_unit
from tehl_taichi.runs.sweep.study_table import Study, attributes
from tehl_taichi.runs.sweep.summary_columns import JUDGED, error_of, usual_columns
from tehl_taichi.scene.aliases import full_name
from tehl_taichi.values.digits import number_of, part_of, with_bar, with_error

MOST_ROWS = 500
ROUNDING = 1e-12  # of the largest value: friction in pure rolling


def of(folder):
    """The :class:`tehl_taichi.report.document.Page` of the study in `folder`. Raises StoreError."""
    study = Study.open(folder)
    scene, keys = study.plan.scene, ", ".join(map(key_name, study.plan.keys))
    cases = number_of(len(study), "case")
    return Page(f"{scene.name}: report of a study", f"{scene.name}: {cases} over {keys}", _answer(study), (
        Section("Results", (figure_block(*figures(study)), _effects(study))), Section("Cases", (_table(study), _rest(study))),
        Section("Without a result", (sentences(_failed(study)),)), _scene(study),
        Section("Provenance", (facts(_provenance(study)),))))


def _scene(study):
    """Section about the common scene of all cases, with the changed keys."""
    found = scene_section(study.plan.scene, "")
    return replace(found, parts=(sentences(list(_swept(study)), "The cases change"), *found.parts))


def _swept(study):
    """A sentence on the values of every swept key."""
    for key in study.plan.keys:
        numbers, label, words = study_figures.axis_values(study, key, per_case=True)
        ends = [words[int(which(numbers))] for which in (np.argmin, np.argmax)]
        several = len(dict.fromkeys(words))
        if study_figures.numeric(study, key) and several > 2:
            yield f"{label_with_value(label, ' to '.join(ends))}: {several} values in place of that below."
        else:
            yield f"{label_with_value(label, ', '.join(dict.fromkeys(words)))} in place of that below."


def _column(study, name):
    return study.values.get(name, np.full(len(study), np.nan))


def _answer(study):
    Fi, waiting = _column(study, JUDGED), study.counts["waiting"]
    known, bad = np.isfinite(Fi), len(study) - waiting - study.counts["converged"]
    doubts = [f"Without a result: {part_of(bad, len(study), 'case')}; the list below says why."] * bool(bad)
    doubts += [f"Not run yet: {part_of(waiting, len(study), 'case')}."] * bool(waiting)
    if not known.any():
        headline = f"{part_of(study.counts['converged'], len(study), 'case', 'has', 'have')} a result."
        return Answer("What are the results of the study?", headline, "none", tuple(_ranges(study)), tuple(doubts))
    states, of_all = [judged(*one) for one in zip(Fi[known], _errors(study)[known])], int(known.sum())
    above, within = states.count(ABOVE), states.count(WITHIN)
    doubtful = f"; 1 lies within the error in {within} more" * bool(within)
    headline = f"The index that decides is above 1 in {part_of(above, of_all, 'case')} with a result{doubtful}."
    tone = "yes" if above == of_all else "open" if above + within else "no"
    return Answer("In which cases does a fatigue crack start?", headline, tone,
                  (_extreme(study, Fi, "largest", np.nanargmax), _extreme(study, Fi, "smallest", np.nanargmin)),
                  (*_limits(study), *doubts, *_unknown(study)))


def _limits(study):
    """Sentences about the meaning of Fi = 1, if it is equal in all cases."""
    swept = [key for key in study.plan.keys if full_name(key).startswith("fatigue.")]
    if swept:
        return (f"The fatigue limit, or what belongs to it, differs between the cases: {', '.join(swept)}.",)
    return limit_words(study.plan.scene)


def _ranges(study):
    """Sentence about the range of each usual result, with the cases of the smallest and the largest value."""
    for name in usual_columns(study.values):
        values, errors, label = study_figures.with_errors(study, name)
        if np.isfinite(values).any():
            name, unit = name_and_unit(label)
            low, top = (_with_case(study, values, errors, unit, n)
                        for n in (int(np.nanargmin(values)), int(np.nanargmax(values))))
            yield f"{sentence_case(name)}: {low} to {top}."


def _with_case(study, values, errors, unit, n):
    """Text of a value, and of its case."""
    unknown = "error unknown, " * (not np.isfinite(errors[n]) and not _is_rounding(values, n))
    return f"{_value(values, errors, n)}{f' {unit}' * bool(unit)} ({unknown}{_changes(study, n)})"


def _value(values, errors, n):
    """Text of a value with its error, four digits without; rounding errors relative to the largest value are 0."""
    return "0" if _is_rounding(values, n) else with_error(values[n], errors[n])


def _cell(values, errors, n):
    """Text of a value with a mark if its error is not known."""
    text = _value(values, errors, n)
    return text if _is_rounding(values, n) else with_bar(text, errors[n])


def _is_rounding(values, n):
    return abs(values[n]) <= ROUNDING * np.nanmax(np.abs(values))


def _extreme(study, Fi, text, which):
    n = int(which(Fi))
    return f"The {text} is Fi = {value_text(Fi[n])}: {_changes(study, n)}."


def _errors(study):
    """Errors of the index that decides, 0 where unknown: then only its value counts."""
    return np.nan_to_num(_column(study, error_of(JUDGED)))


def _unknown(study):
    """Sentence: number of cases whose index has no error."""
    unknown = int((np.isfinite(_column(study, JUDGED)) & ~np.isfinite(_column(study, error_of(JUDGED)))).sum())
    return [f"The error of the index is not known: {part_of(unknown, len(study), 'case')}."] * bool(unknown)


def _changes(study, n):
    keys = (study_figures.axis_values(study, key, per_case=True) for key in study.plan.keys)
    return ", ".join(label_with_value(label, words[n]) for _, label, words in keys)


def _table(study):
    keys = [study_figures.axis_values(study, key, per_case=True) for key in study.plan.keys]
    columns = [study_figures.with_errors(study, name) for name in usual_columns(study.values)]
    rows = [[str(n), *(words[n] for *_, words in keys), row["status"],
             *(_cell(values, errors, n) if np.isfinite(values[n]) else "" for values, errors, _ in columns)]
            for n, row in zip(range(MOST_ROWS), study.rows())]
    return table(("case", *(label for _, label, _ in keys), "status", *(label for *_, label in columns)), rows)


def _effects(study):
    """Table of the share of the spread of each usual result that a key accounts for; None without any."""
    found = usual_effects(study)
    axes = list(dict.fromkeys(keys for one in found.values() for keys in one.shares))
    rows = [[sentence_case(column_name(name)), *(f"{one.shares[keys]:.0%}" for keys in axes),
             "" if one.together is None else f"{one.together:.0%}"] for name, one in found.items()]
    heads = ("", *(", ".join(map(key_name, keys)) for keys in axes), "keys together")
    return table(heads, rows, "Share of the spread of each result that a key accounts for")


def _rest(study):
    return sentences([f"{len(study) - MOST_ROWS} more are in {study.table.name}."]) if len(study) > MOST_ROWS else None


def _failed(study):
    return [f"Case {record['case']} ({_changes(study, record['case'])}): {record['status']}: {record['reason']}"
            for record in study.results() if not record["converged"]]


def _provenance(study):
    attrs, seconds = attributes(study.path), sum(record.get("seconds") or 0.0 for record in study.results())
    return [("study", study.path.name), *((key, str(attrs[key])) for key in ("version", "commit") if key in attrs),
            ("run time of all cases", f"{seconds:.0f} s"), *((key, str(value)) for key, value in study.plan.drawn.items())]
