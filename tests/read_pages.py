"""Pages of reports, read back."""

import base64
import gzip
import html.parser
import json

import numpy as np

import tehl_taichi as tehl

EMPTY = {"meta", "link", "br", "input", "img"}


class Seen(html.parser.HTMLParser):
    """What stands on a page: its text, the attributes of its tags, what the scripts carry. Tags close in order."""

    def __init__(self, page):
        super().__init__()
        self.open, self.text, self.attributes, self.carried, self.headings = [], "", [], {}, []
        self.feed(page)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attributes):
        self.attributes += [(tag, *pair) for pair in attributes]
        if tag not in EMPTY:
            self.open.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open.pop()[0] == tag

    def handle_data(self, data):
        tag, attributes = self.open[-1] if self.open else ("", {})
        if tag in ("script", "style"):
            self.carried[attributes.get("id", tag)] = data
            return
        self.text += " ".join(data.split()) + "\n" * bool(data.strip())
        self.headings += [data] * (tag == "h2")

    @property
    def figures(self):
        """{name: plotly's}, unpacked."""
        if "figures" not in self.carried:
            return {}
        return json.loads(gzip.decompress(base64.b64decode(self.carried["figures"])))

    @property
    def places(self):
        """Names of the figures that have a place."""
        return [value for _, key, value in self.attributes if key == "data-figure"]


def page(of, tmp_path):
    return Seen(tehl.report(of, tmp_path / "page.html", force=True).read_text(encoding="utf-8"))


def numbers(trace):
    """The drawn values of a trace."""
    return values(trace.get("z", trace["y"]))


def values(drawn):
    """Those of an axis."""
    if isinstance(drawn, dict):
        return np.frombuffer(base64.b64decode(drawn["bdata"]), "<f4")
    return np.array([value for value in drawn if value is not None], float)
