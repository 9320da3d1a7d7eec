"""Scenes, pages, figures, stills and movies of motions."""

from polhode.view import figures as figures
from polhode.view._audit_page import audit_html as audit_html
from polhode.view._audit_page import audit_page as audit_page
from polhode.view._judgement import Judgement as Judgement
from polhode.view._markup import math_fonts as math_fonts
from polhode.view._mathml import equation as equation
from polhode.view._notebook_declared import html_of as html_of
from polhode.view._page import page as page
from polhode.view._page import page_of as page_of
from polhode.view._scene import MotionSummary as MotionSummary
from polhode.view._scene import Scene as Scene
from polhode.view._scene import plain as plain
from polhode.view._scene_build import account as account
from polhode.view._scene_build import poses as poses
from polhode.view._scene_build import scene as scene
from polhode.view._scene_build import scenery as scenery
from polhode.view._typeset import typeset as typeset
from polhode.view.figures._run import figure_of_run as figure_of_run
from polhode.view.figures._run import plot as plot
from polhode.view.figures._save import origin_of as origin_of
from polhode.view.figures._save import save_figure as save_figure
from polhode.view.figures._save import svg_of as svg_of
from polhode.view.stills import movie as movie
from polhode.view.stills import picture as picture
from polhode.view.stills import still as still
from polhode.view.stills import telling_time as telling_time
