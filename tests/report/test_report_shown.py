"""Reports in a headless Chromium: they draw without a complaint, the slider moves, phones and paper hold them."""

import made_results
import pytest
from browser import CHROMIUM, Browser
from fake_cases import formula

import tehl_taichi as tehl
from tehl_taichi.report import plots
from tehl_taichi.report.document import Answer, Page, Section, figure_block, render
from tehl_taichi.runs.sweep import sweeping
from tehl_taichi.runs.sweep.plan import plan
from tehl_taichi.scene import scene

pytest.importorskip("plotly")
pytest.importorskip("jinja2")
pytestmark = pytest.mark.skipif(not CHROMIUM, reason="no Chromium is installed, which shows the reports")
LINE = scene("furrow-line").replace(**{"grid.nx": 32})
SHOWN = "Array.from(document.querySelector('[data-figure=centreline]').data[1].y)"


DRAWN = "[...document.querySelectorAll('.plot .main-svg')]"
# what the page's own policy stops, whether there is a network or not
REFUSED = """new Promise(done => {
  document.addEventListener("securitypolicyviolation", event => done(event.blockedURI));
  fetch("https://example.org/").catch(() => 0);
  setTimeout(() => done("nothing"), 3000);
})"""


@pytest.fixture(scope="module")
def browser(tmp_path_factory):
    with Browser(tmp_path_factory.mktemp("profile")) as opened:
        yield opened


@pytest.fixture(scope="module")
def line(browser, tmp_path_factory):
    """The browser with the page of a line, which has few figures."""
    browser.open(tehl.report(made_results.run(tmp_path_factory.mktemp("line") / "a.zarr", LINE, 4)))
    return browser


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The page of a run with everything."""
    return tehl.report(made_results.run(tmp_path_factory.mktemp("whole") / "a.zarr", search=made_results.fatigue()))


@pytest.fixture(scope="module")
def others(tmp_path_factory):
    """Pages of a study and of a flank."""
    folder = tmp_path_factory.mktemp("others")
    planned = plan(LINE, {"srr": "-0.1:0.1:3", "feature.width": [4e-4, 5e-4]})
    study = sweeping.run(planned, folder / "s.zarr", workers=1, work=formula)
    return tehl.report(study), tehl.report(made_results.flank(folder / "flank"))


def test_the_slider_moves_the_lines_and_nothing_complains(line):
    assert line.run("document.getElementById('slide').value") == "3"
    last, said = line.run(SHOWN), line.run("document.querySelector('output').value")
    line.run("document.getElementById('slide').focus()")
    line.press("ArrowLeft")
    assert line.run("document.getElementById('slide').value") == "2"
    one_before = line.run(SHOWN)
    assert max(one_before) == pytest.approx(max(last) - 0.1 * 2.0034, rel=1e-3)
    now = line.run("document.querySelector('output').value")
    assert said.startswith("feature at +0.00 a") and now.startswith("feature at -0.50")
    shape = "document.querySelector('[data-figure=centreline]').layout.shapes[0].x0"
    assert line.run(shape) == pytest.approx(-0.5)
    assert line.complaints() == []


def test_a_rectangle_zooms(line):
    place = "document.querySelector('[data-figure=centreline] .nsewdrag')"
    line.run(f"{place}.scrollIntoView({{block: 'center'}})")
    left, top, width, height = line.run(f"(box => [box.x, box.y, box.width, box.height])({place}.getBoundingClientRect())")
    before = line.run("document.querySelector('[data-figure=centreline]').layout.xaxis.range")
    line.drag((left + 0.25 * width, top + 0.2 * height), (left + 0.75 * width, top + 0.8 * height))
    after = line.run("document.querySelector('[data-figure=centreline]').layout.xaxis.range")
    assert after[1] - after[0] == pytest.approx(0.5 * (before[1] - before[0]), rel=0.02)


def test_no_button_sends_data_away(line):
    buttons = line.run("[...document.querySelectorAll('.modebar-btn')].map(button => button.dataset.title)")
    assert set(buttons) == {"Download plot as a PNG", "Zoom", "Pan", "Zoom in", "Zoom out", "Reset axes"}
    assert line.run(REFUSED) == "https://example.org/"


@pytest.mark.slow
def test_every_kind_of_page_draws_all_its_figures(browser, whole, others):
    for path in (whole, *others):
        browser.open(path)
        assert browser.complaints() == []
        assert browser.run("[...document.querySelectorAll('.plot')].every(place => place.querySelector('.main-svg'))")


@pytest.mark.slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_phone_scrolls_down_only_and_every_text_is_legible(browser, whole, others, scheme):
    for path in (whole, *others):
        browser.open(path, 360, 740, phone=True, scheme=scheme)
        assert browser.run("document.documentElement.scrollWidth") <= 360, path
        assert max(browser.run(f"{DRAWN}.map(svg => svg.getBoundingClientRect().right)")) <= 360
        assert browser.run(CONTRAST) >= 4.5


# smallest ratio of luminances (WCAG) of texts on their backgrounds
CONTRAST = """(() => {
  const numbers = text => text.match(/[\\d.]+/g).map(Number);
  const light = text => numbers(text).slice(0, 3).map(v => v / 255)
    .map(v => v <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
    .reduce((sum, v, n) => sum + v * [0.2126, 0.7152, 0.0722][n], 0);
  const behind = place => { const c = getComputedStyle(place).backgroundColor;
    return place.parentElement && (numbers(c)[3] === 0) ? behind(place.parentElement) : c; };
  const ratio = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
  const texts = [...document.querySelectorAll("p, li, dt, dd, th, td, a, h1, h2, b, figcaption, output, summary")];
  const axes = [...document.querySelectorAll(".xtick text, .ytick text, .legendtext, .ytitle")];
  return Math.min(...texts.map(place => ratio(light(getComputedStyle(place).color), light(behind(place)))),
                  ...axes.map(place => ratio(light(getComputedStyle(place).fill), light(behind(document.body)))));
})()"""


@pytest.mark.slow
def test_paper_is_light_and_holds_every_figure(browser, whole, tmp_path):
    browser.open(whole, scheme="dark")
    browser.run("dispatchEvent(new Event('beforeprint')); new Promise(done => setTimeout(done, 500))")
    widths = "[...document.querySelectorAll({!r})].map(svg => svg.getBoundingClientRect().width)".format
    beside, every = browser.run(widths(".front .three .main-svg")), browser.run(widths(".plot .main-svg"))
    assert min(every) >= 200 and max(every) <= 660 and min(width for width in every if width not in beside) >= 300
    assert browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)"
    assert browser.run(CONTRAST) >= 4.5
    browser.run("dispatchEvent(new Event('afterprint')); new Promise(done => setTimeout(done, 500))")
    assert browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(20, 24, 28)"
    assert browser.run("document.querySelector('[data-figure=centreline] .main-svg').getBoundingClientRect().width") > 900
    browser.paper(tmp_path / "a.pdf")
    assert (tmp_path / "a.pdf").read_bytes()[:4] == b"%PDF" and browser.complaints() == []


def test_a_page_counts_as_loading_until_its_figures_are_drawn(others, tmp_path):
    """A browser without a screen prints what is there once a page has loaded: figures, not empty frames."""
    import subprocess

    from browser import CHROMIUM, FLAGS

    sizes = []
    for number, page in enumerate((others[1], tmp_path / "empty.html")):
        if number:  # the page without the library that draws
            text = others[1].read_text()
            page.write_text(text.replace('id="library"', 'id="lost"'))
        command = [CHROMIUM, *(flag for flag in FLAGS if "pipe" not in flag), f"--user-data-dir={tmp_path / 'b'}",
                   f"--print-to-pdf={tmp_path / 'a.pdf'}", page.as_uri()]
        subprocess.run(command, check=True, capture_output=True, timeout=120)
        sizes.append((tmp_path / "a.pdf").stat().st_size)
    assert sizes[0] > 1.2 * sizes[1]


PAGE = 1017  # px: height of A4 between its margins
WIDE = 688   # px: its width


def test_paper_holds_the_widest_table(browser, others):
    """Nothing of a table is cut, which a screen would let the reader scroll."""
    browser.open(others[1], width=WIDE)
    browser.ask("Emulation.setEmulatedMedia", media="print")
    widest = browser.run("Math.max(...[...document.querySelectorAll('table')].map(one => one.scrollWidth))")
    assert widest <= WIDE and browser.run("getComputedStyle(document.querySelector('.wide')).overflowX") == "visible"
    browser.ask("Emulation.setEmulatedMedia", media="")


def test_paper_has_the_answer_and_its_figures_on_two_pages(browser, whole):
    """The chain and three figures follow the verdict; the rest is an appendix that begins on a new page."""
    browser.open(whole, width=WIDE)
    hidden = "getComputedStyle(document.querySelector('.appendix'))"
    assert browser.run(f"{hidden}.display") == "none"
    browser.ask("Emulation.setEmulatedMedia", media="print")
    browser.run("dispatchEvent(new Event('beforeprint')); new Promise(done => setTimeout(done, 500))")
    assert browser.run(f"[{hidden}.display, {hidden}.breakBefore]") == ["block", "page"]
    height = "document.querySelector({!r}).getBoundingClientRect().height".format
    assert browser.run(height("header")) < PAGE and browser.run(height("section.front")) < PAGE
    assert browser.run("document.querySelectorAll('.front .plot').length") == 4
    assert browser.run("document.querySelector('.appendix').nextElementSibling.id") == "scene"
    assert browser.run("[...document.querySelectorAll('.front')].pop().nextElementSibling.className") == "appendix"
    plot = browser.run("document.querySelector('.front .plot').offsetHeight")
    browser.ask("Emulation.setEmulatedMedia", media="")
    browser.run("dispatchEvent(new Event('afterprint')); new Promise(done => setTimeout(done, 500))")
    assert browser.run("document.querySelector('.front .plot').offsetHeight") > plot


@pytest.mark.parametrize("rows", [1, 3])
def test_rows_of_figures_share_two_printed_pages_with_the_answer(browser, tmp_path, rows):
    """As those of an ellipse, one below the other."""
    drawn, said = [plots.line([0, 1], [0, 1], "p", "#000")], "A sentence about it. " * 8
    figures = [plots.Figure(f"f{n}", said, drawn, {}, 460) for n in range(rows)]
    page = Page("a page", "", Answer("Is it?", "Yes.", "yes"), (Section("Maps", tuple(map(figure_block, figures))),))
    (tmp_path / "a.html").write_text(render(page))
    browser.open(tmp_path / "a.html", width=WIDE)
    browser.ask("Emulation.setEmulatedMedia", media="print")
    browser.run("dispatchEvent(new Event('beforeprint')); new Promise(done => setTimeout(done, 500))")
    height = browser.run("document.querySelector('section.front').getBoundingClientRect().height")
    browser.ask("Emulation.setEmulatedMedia", media="")
    assert (1 / 3 if rows == 1 else 1) * PAGE < height < (1 if rows == 1 else 5 / 4) * PAGE


def test_figures_along_a_flank_fit_a_printed_page(browser, others):
    """Seven, in three columns; those of a study, too."""
    for path in others:
        browser.open(path, width=WIDE)
        browser.ask("Emulation.setEmulatedMedia", media="print")
        browser.run("dispatchEvent(new Event('beforeprint')); new Promise(done => setTimeout(done, 500))")
        assert browser.run("document.querySelector('section.front').getBoundingClientRect().height") < PAGE, path
        browser.ask("Emulation.setEmulatedMedia", media="")
