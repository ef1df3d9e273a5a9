"""Figures in memory for notebooks."""

import base64
import io


class Figures(dict):
    """{name: matplotlib Figure}; a notebook shows all of them."""

    def __init__(self, figures, dpi):
        super().__init__(figures)
        self.dpi = dpi

    def __repr__(self):
        return f"<tehl figures: {', '.join(self)}>"

    def _repr_html_(self):
        return "".join(f'<figure><img alt="{name}" {self._size(figure)} src="data:image/png;base64,{self._png(figure)}">'
                       "</figure>" for name, figure in self.items())

    def _size(self, figure):
        """Attributes of its size, so that a page has room for it before it is shown; a narrow page makes it smaller."""
        wide, high = (round(inches * self.dpi) for inches in figure.get_size_inches())
        return f'width="{wide}" height="{high}" style="max-width: 100%; height: auto"'

    def _png(self, figure):
        draft = io.BytesIO()
        figure.savefig(draft, format="png", dpi=self.dpi)
        return base64.b64encode(draft.getvalue()).decode()
