"""Scenes, pages and figures of motions; every figure takes `ax=` and returns what it drew."""

from polhode.view._energy import energies as energies
from polhode.view._energy import energy_drift as energy_drift
from polhode.view._floor import floor_path as floor_path
from polhode.view._floor import support_trace as support_trace
from polhode.view._friction import friction_needed as friction_needed
from polhode.view._history import history as history
from polhode.view._nutation import nutation as nutation
from polhode.view._page import page as page
from polhode.view._page import page_of as page_of
from polhode.view._phase import phase_portrait as phase_portrait
from polhode.view._polhodes import polhodes as polhodes
from polhode.view._reactions import reaction_ranges as reaction_ranges
from polhode.view._reactions import reactions as reactions
from polhode.view._run import figure_of_run as figure_of_run
from polhode.view._save import origin_of as origin_of
from polhode.view._save import save_figure as save_figure
from polhode.view._save import svg_of as svg_of
from polhode.view._scene import Judgement as Judgement
from polhode.view._scene import Scene as Scene
from polhode.view._scene_build import scene as scene
from polhode.view._style import WIDTH as WIDTH
from polhode.view._style import axes_or_new as axes_or_new
from polhode.view._style import for_dark_pages as for_dark_pages
from polhode.view._style import house_style as house_style
from polhode.view._style import new_figure as new_figure
