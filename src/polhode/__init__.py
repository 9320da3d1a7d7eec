"""polhode: rigid-body mechanics, worked as a good text works it.

Public names are imported from their packages on first use, so that ``import polhode`` is fast.
"""

import logging
import sys
from importlib import import_module
from types import ModuleType
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from polhode.algebra import Expr as Expr
    from polhode.algebra import Matrix as Matrix
    from polhode.algebra import Symbol as Symbol
    from polhode.algebra import SymbolKind as SymbolKind
    from polhode.algebra import Vector as Vector
    from polhode.algebra import absolute as absolute
    from polhode.algebra import compile_program as compile_program
    from polhode.algebra import coordinate as coordinate
    from polhode.algebra import coordinates as coordinates
    from polhode.algebra import cos as cos
    from polhode.algebra import cosh as cosh
    from polhode.algebra import exp as exp
    from polhode.algebra import from_sympy as from_sympy
    from polhode.algebra import functions as functions
    from polhode.algebra import integrate as integrate
    from polhode.algebra import is_positive as is_positive
    from polhode.algebra import pi as pi
    from polhode.algebra import reaction as reaction
    from polhode.algebra import sech as sech
    from polhode.algebra import shorter as shorter
    from polhode.algebra import sin as sin
    from polhode.algebra import sinh as sinh
    from polhode.algebra import speed as speed
    from polhode.algebra import speeds as speeds
    from polhode.algebra import sqrt as sqrt
    from polhode.algebra import symbol as symbol
    from polhode.algebra import symbols as symbols
    from polhode.algebra import tan as tan
    from polhode.algebra import tanh as tanh
    from polhode.algebra import taylor as taylor
    from polhode.algebra import time as time
    from polhode.algebra import to_sympy as to_sympy
    from polhode.analyse import Ansatz as Ansatz
    from polhode.analyse import Blow as Blow
    from polhode.analyse import ClosedForm as ClosedForm
    from polhode.analyse import Condition as Condition
    from polhode.analyse import Departures as Departures
    from polhode.analyse import Invariant as Invariant
    from polhode.analyse import Invariants as Invariants
    from polhode.analyse import Lagrangian as Lagrangian
    from polhode.analyse import LinearIntegrals as LinearIntegrals
    from polhode.analyse import Opening as Opening
    from polhode.analyse import Stability as Stability
    from polhode.analyse import SteadyMotion as SteadyMotion
    from polhode.analyse import SteadyValues as SteadyValues
    from polhode.analyse import Truth as Truth
    from polhode.analyse import closed_form as closed_form
    from polhode.analyse import contact_forces as contact_forces
    from polhode.analyse import departures as departures
    from polhode.analyse import expand as expand
    from polhode.analyse import fictitious_force as fictitious_force
    from polhode.analyse import fictitious_torque as fictitious_torque
    from polhode.analyse import invariants as invariants
    from polhode.analyse import lagrangian as lagrangian
    from polhode.analyse import leaves as leaves
    from polhode.analyse import linear_integrals as linear_integrals
    from polhode.analyse import stability as stability
    from polhode.analyse import steady as steady
    from polhode.analyse import steady_values as steady_values
    from polhode.analyse import strike as strike
    from polhode.base import ConstraintError as ConstraintError
    from polhode.base import DeclarationError as DeclarationError
    from polhode.base import DriftWarning as DriftWarning
    from polhode.base import NumericError as NumericError
    from polhode.base import ParseError as ParseError
    from polhode.base import PolhodeError as PolhodeError
    from polhode.base import StoreError as StoreError
    from polhode.base import UnitError as UnitError
    from polhode.derive import Automaton as Automaton
    from polhode.derive import Equations as Equations
    from polhode.derive import Reaction as Reaction
    from polhode.derive import automaton as automaton
    from polhode.derive import derive as derive
    from polhode.exercise import Exercise as Exercise
    from polhode.exercise import exercise as exercise
    from polhode.judge import Mark as Mark
    from polhode.judge import Report as Report
    from polhode.judge import Review as Review
    from polhode.judge import ReviewedLine as ReviewedLine
    from polhode.judge import Verdict as Verdict
    from polhode.judge import audit as audit
    from polhode.judge import check as check
    from polhode.judge import read_file as read_file
    from polhode.judge import review as review
    from polhode.judge import review_files as review_files
    from polhode.model import About as About
    from polhode.model import Action as Action
    from polhode.model import Body as Body
    from polhode.model import BodyPoint as BodyPoint
    from polhode.model import CentralForce as CentralForce
    from polhode.model import Components as Components
    from polhode.model import Cone as Cone
    from polhode.model import Constraint as Constraint
    from polhode.model import Coulomb as Coulomb
    from polhode.model import Cylinder as Cylinder
    from polhode.model import Damper as Damper
    from polhode.model import DrillingFriction as DrillingFriction
    from polhode.model import Ellipsoidal as Ellipsoidal
    from polhode.model import Face as Face
    from polhode.model import Force as Force
    from polhode.model import Frame as Frame
    from polhode.model import Free as Free
    from polhode.model import Gear as Gear
    from polhode.model import Graph as Graph
    from polhode.model import Gravity as Gravity
    from polhode.model import Guide as Guide
    from polhode.model import Hinge as Hinge
    from polhode.model import Hold as Hold
    from polhode.model import KnifeEdge as KnifeEdge
    from polhode.model import Load as Load
    from polhode.model import MagneticMoment as MagneticMoment
    from polhode.model import Motor as Motor
    from polhode.model import Parametric as Parametric
    from polhode.model import Pivot as Pivot
    from polhode.model import Plane as Plane
    from polhode.model import Potential as Potential
    from polhode.model import Profile as Profile
    from polhode.model import Rack as Rack
    from polhode.model import Relative as Relative
    from polhode.model import Revolution as Revolution
    from polhode.model import Rim as Rim
    from polhode.model import Rolling as Rolling
    from polhode.model import RollingResistance as RollingResistance
    from polhode.model import Rope as Rope
    from polhode.model import Round as Round
    from polhode.model import Screw as Screw
    from polhode.model import Sheet as Sheet
    from polhode.model import Slider as Slider
    from polhode.model import Smooth as Smooth
    from polhode.model import Sphere as Sphere
    from polhode.model import Spring as Spring
    from polhode.model import Surface as Surface
    from polhode.model import System as System
    from polhode.model import Torque as Torque
    from polhode.model import TorsionDamper as TorsionDamper
    from polhode.model import TorsionSpring as TorsionSpring
    from polhode.model import Torus as Torus
    from polhode.model import Turntable as Turntable
    from polhode.model import Universal as Universal
    from polhode.model import Weld as Weld
    from polhode.model import WithAxes as WithAxes
    from polhode.model import box as box
    from polhode.model import centre_of_mass as centre_of_mass
    from polhode.model import compound as compound
    from polhode.model import cone as cone
    from polhode.model import cylinder as cylinder
    from polhode.model import disk as disk
    from polhode.model import earth as earth
    from polhode.model import ellipsoid as ellipsoid
    from polhode.model import hoop as hoop
    from polhode.model import point_mass as point_mass
    from polhode.model import rod as rod
    from polhode.model import sphere as sphere
    from polhode.model import upright as upright
    from polhode.model import with_edge as with_edge
    from polhode.model import with_friction as with_friction
    from polhode.simulate import Pieces as Pieces
    from polhode.simulate import Trajectory as Trajectory
    from polhode.simulate import approximated as approximated
    from polhode.simulate import export as export
    from polhode.simulate import load as load
    from polhode.simulate import read_sheet as read_sheet
    from polhode.simulate import sampled as sampled
    from polhode.simulate import simulate as simulate
    from polhode.solution import Solution as Solution
    from polhode.solution import solution as solution
    from polhode.solution import write_solution as write_solution
    from polhode.study import Duration as Duration
    from polhode.study import EndMode as EndMode
    from polhode.study import Ensemble as Ensemble
    from polhode.study import EventCount as EventCount
    from polhode.study import EventKinds as EventKinds
    from polhode.study import EventTime as EventTime
    from polhode.study import EventTimes as EventTimes
    from polhode.study import Fate as Fate
    from polhode.study import Final as Final
    from polhode.study import Fit as Fit
    from polhode.study import Linearised as Linearised
    from polhode.study import Maximum as Maximum
    from polhode.study import Minimum as Minimum
    from polhode.study import Modes as Modes
    from polhode.study import Sensitivities as Sensitivities
    from polhode.study import StabilityChange as StabilityChange
    from polhode.study import TimeSeries as TimeSeries
    from polhode.study import ensemble as ensemble
    from polhode.study import fit as fit
    from polhode.study import linearise as linearise
    from polhode.study import modes as modes
    from polhode.study import refine_map as refine_map
    from polhode.study import sensitivities as sensitivities
    from polhode.study import sweep as sweep
    from polhode.view import Judgement as Judgement
    from polhode.view import Scene as Scene
    from polhode.view import figures as figures
    from polhode.view import movie as movie
    from polhode.view import page as page
    from polhode.view import plot as plot
    from polhode.view import scene as scene
    from polhode.view import still as still

    __version__: str

_NAMES = {
    "algebra": """
        Expr Matrix Symbol SymbolKind Vector absolute compile_program coordinate coordinates cos
        cosh exp from_sympy functions integrate is_positive pi reaction sech shorter sin sinh speed
        speeds sqrt symbol symbols tan tanh taylor time to_sympy
    """,
    "analyse": """
        Ansatz Blow ClosedForm Condition Departures Invariant Invariants Lagrangian LinearIntegrals
        Opening Stability SteadyMotion SteadyValues Truth closed_form contact_forces departures
        expand fictitious_force fictitious_torque invariants lagrangian leaves linear_integrals
        stability steady steady_values strike
    """,
    "base": """
        ConstraintError DeclarationError DriftWarning NumericError ParseError PolhodeError
        StoreError UnitError
    """,
    "derive": "Automaton Equations Reaction automaton derive",
    "exercise": "Exercise exercise",
    "judge": """
        Mark Report Review ReviewedLine Verdict audit check read_file review review_files
    """,
    "model": """
        About Action Body BodyPoint CentralForce Components Cone Constraint Coulomb Cylinder Damper
        DrillingFriction Ellipsoidal Face Force Frame Free Gear Graph Gravity Guide Hinge Hold
        KnifeEdge Load MagneticMoment Motor Parametric Pivot Plane Potential Profile Rack Relative
        Revolution Rim Rolling RollingResistance Rope Round Screw Sheet Slider Smooth Sphere Spring
        Surface System Torque TorsionDamper TorsionSpring Torus Turntable Universal Weld WithAxes
        box centre_of_mass compound cone cylinder disk earth ellipsoid hoop point_mass rod sphere
        upright with_edge with_friction
    """,
    "simulate": "Pieces Trajectory approximated export load read_sheet sampled simulate",
    "solution": "Solution solution write_solution",
    "study": """
        Duration EndMode Ensemble EventCount EventKinds EventTime EventTimes Fate Final Fit
        Linearised Maximum Minimum Modes Sensitivities StabilityChange TimeSeries ensemble fit
        linearise modes refine_map sensitivities sweep
    """,
    "view": "Judgement Scene figures movie page plot scene still",
}
_HOME = {name: f"polhode.{package}" for package, names in _NAMES.items() for name in names.split()}

__all__ = [*_HOME, "__version__"]

logging.getLogger("polhode").addHandler(logging.NullHandler())


def __getattr__(name: str) -> Any:
    if name == "__version__":
        from importlib.metadata import version

        value: Any = version("polhode")
    elif name in _HOME:
        value = getattr(import_module(_HOME[name]), name)
        # Results draw themselves in notebooks, but `base` must not import `view`: it is given a
        # function that does so when a notebook first asks.
        import_module("polhode.base").show_with(_html)
    else:
        raise AttributeError(f"module 'polhode' has no attribute {name!r}")
    globals()[name] = value  # so that the next access does not come here
    return value


def _html(thing: object) -> str:
    """HTML of an object for a notebook."""
    # What shows verdicts and reviews is in `judge`, of which `view` does not know.
    is_judged = type(thing).__module__.startswith("polhode.judge")
    html: str = import_module(f"polhode.{'judge' if is_judged else 'view'}").html_of(thing)
    return html


def __dir__() -> list[str]:
    return sorted(__all__)


class _LazyPackage(ModuleType):
    """Keeps an imported subpackage from hiding the function of the same name: ``ph.derive``."""

    def __setattr__(self, name: str, value: object) -> None:
        # The import system sets each imported subpackage as an attribute of its parent.
        if not (name in _HOME and isinstance(value, ModuleType)):
            super().__setattr__(name, value)


sys.modules[__name__].__class__ = _LazyPackage
