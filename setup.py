"""What pyproject.toml cannot say: every folder is a package; a wheel and a source archive know their commit."""

import runpy
from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.build_py import build_py
from setuptools.command.sdist import sdist

COMMIT = "tehl_taichi/commit.txt"


def write(folder):
    """Put the commit of this checkout (or of the archive that it is) into the tree that is built."""
    target = Path(folder) / COMMIT
    target.unlink(missing_ok=True)  # a source archive may hold links to the checkout's own files
    target.write_text(runpy.run_path("tehl_taichi/commit.py")["commit"]() + "\n")


class BuildModules(build_py):
    def run(self):
        super().run()
        if not self.editable_mode:
            write(self.build_lib)


class SourceArchive(sdist):
    def make_release_tree(self, base_dir, files):
        super().make_release_tree(base_dir, files)
        write(base_dir)


PACKAGES = [*find_packages(include=["tehl_taichi", "tehl_taichi.*"]), "tehl_taichi.profiles", "tehl_cli"]

setup(packages=PACKAGES, cmdclass={"build_py": BuildModules, "sdist": SourceArchive})
