"""Citation of this program."""

from tehl_cli.stdout import put

from tehl_taichi import __released__, __version__
from tehl_taichi.commit import commit

TITLE = "tehl_taichi: transient elastohydrodynamic contacts with surface features, and the fatigue they cause"
AUTHORS = "the tehl_taichi developers"


def cite():
    """Print the BibTeX entry of this version, and of the thesis behind the model.

    Example: `tehl cite >> references.bib`
    """
    put(bibtex(), keep="\n")


def bibtex():
    """BibTeX entries with version, year and commit."""
    return f"""@software{{tehl_taichi,
  title = {{{TITLE}}},
  author = {{{{{AUTHORS}}}}},
  version = {{{__version__}}},
  year = {{{__released__[:4]}}},
  note = {{commit {commit()}}},
}}

@phdthesis{{everitt2018,
  title = {{Initiation of rolling contact fatigue from asperities in elastohydrodynamic lubricated contacts}},
  author = {{Everitt, Carl-Magnus}},
  school = {{KTH Royal Institute of Technology}},
  type = {{Licentiate thesis}},
  year = {{2018}},
}}"""
