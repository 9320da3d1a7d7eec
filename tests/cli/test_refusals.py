"""Bad input: one clear line, exit code 2, nothing on standard output and nothing written."""

import pytest

REFUSALS = [
    ("list --jso", "polhode list has no option --jso; did you mean --json?"),
    ("derivate", "'derivate' is no command; expected one of list, derive"),
    ("Derive", "did you mean derive"),
    ("simulate gyroscope", "did you mean run or sweep?"),  # by what these commands do
    ("--hlep run", "polhode has no option --hlep; did you mean --help?"),
    ("-x", "polhode has no option -x; see 'polhode --help'"),
    ("derive", "no NAME; expected 'polhode derive NAME'"),
    ("check gyroscope", "no LATEX; expected 'polhode check NAME LATEX'"),
    ("sweep gyroscope", "'polhode sweep NAME --axis k=FROM:TO:COUNT --out STORE'"),
    ("derive rolling-disc", "did you mean rolling-disk"),
    ("derive a b", "polhode derive takes no argument 'b'; write a value that contains blanks in"),
    ("run", "see 'polhode run --help'"),
    (
        "run rolling-disk --pages x.html",
        "polhode run has no option --pages; did you mean --page",
    ),
    ("run rolling-disk --mu -0.1", "friction coefficient of contact 'ground': -1/10"),
    ("run rolling-disk --mu 0.3 --mu-static 0.2", "mu = 3/10 above mu_static = 1/5"),
    ("run rolling-disk --mu-static 0.2", "--mu-static without --mu"),
    ("run gyroscope --mu 0.2", "friction for 'gyroscope', in which nothing touches a support"),
    ("run rolling-disk --sheet nowhere.csv", "a sheet for 'rolling-disk'"),
    ("run rolling-disk --dur 1s", "polhode run has no option --dur; did you mean --duration?"),
    ("run rolling-disk --set", "argument --set: expected one argument"),
    ("run rolling-disk --set m", "'m'; expected name=value"),
    ("run rolling-disk --set =1", "expected name=value"),
    ("run rolling-disk --set m=", "expected name=value"),
    ("run rolling-disk --set m=1 --set m=2", "m is given twice"),
    ("run rolling-disk --set m=-1", "m = -1; expected a positive value"),
    ("run rolling-disk --set m=0", "m = 0; expected a positive value"),
    ("run rolling-disk theta=1", "did you mean --set theta=1 or --start theta=1?"),
    ("run rolling-disk --start theta=80degrees", "'degrees' is not known; expected m g s rad"),
    ("run rolling-disk --start theta=80degree", "did you mean deg"),
    (
        "run rolling-disk --set pi=3",
        "'pi' is no parameter of rolling-disk; expected one of m, a, g",
    ),
    ("run rolling-disk --set m=nan", "m: 'nan' is not a value; expected a finite number"),
    ("run rolling-disk --set m=inf", "expected a finite number"),
    ("run rolling-disk --set m=1e999kg", "expected a finite number"),
    ("run rolling-disk --set m=1e308", "not finite"),
    ("run rolling-disk --set m=3m", "m = '3m' is a quantity in m; expected a quantity in kg"),
    (
        "run rolling-disk --set M=1",
        "'M' is no parameter of rolling-disk; expected one of m, a, g; did",
    ),
    ("run rolling-disk --set m=__import__('os')", "m: at character 1"),
    ("run rolling-disk --start thta=1", "did you mean theta"),
    ("run rolling-disk --start theta=0", "sin(theta) = 0 at the start"),
    ("run rolling-disk --start omega_3=1e300", "cannot be continued"),
    (
        "run rolling-disk --start psi_dot=3 --start omega_3=4 --start phi_dot=1",
        "psi_dot = 3 at the start contradicts the constraints",
    ),
    ("run rolling-disk --duration -5s", "a duration of -5 s; expected a positive one"),
    ("run rolling-disk --duration 0", "a duration of 0 s"),
    ("run rolling-disk --duration inf", "expected a finite number"),
    ("run rolling-disk --duration 1e300", "a duration of 1e+300 s; expected at most 1e+18 s"),
    ("run rolling-disk --duration 1e16", "steps can cover; try"),
    ("run rolling-disk --duration 0.01 --start omega_3=1e15", "4000 steps cover"),
    ("run rolling-disk --mu 1e300", "mu = 1e+300 of contact 'ground'; expected zero, or a number"),
    ("run rolling-disk --mu 1e-300", "mu = 1e-300 of contact 'ground'; expected zero, or"),
    ("run rolling-disk --duration 0.1s --save /dev/full", "it is a device or a pipe"),
    ("run rolling-disk --duration 0.1s --page x.pdf", "for instance --page x.html"),
    ("run rolling-disk --duration 0.1s --save motion.csv", "for instance --save motion.h5"),
    ("audit --only 1 --html report.PDF", "a name that ends in .html or .htm"),
    ("run rolling-disk --duration 3kg", "expected a quantity in s"),
    ("run tennis-racquet --set I_3=1", "triangle inequality"),
    (
        "run rolling-disk --duration 0.01 --set a=1e200",
        "'disk': not finite",
    ),
    ("run ball-on-paper --set X=sin(q)", "X: at character 5 of 'sin(q)': 'q' is not known"),
    ("run ball-on-paper --set X=1/t", "no finite solution at the start"),
    ("cache", "no action; expected 'polhode cache action'"),
    ("cache empty", "'empty' is no action of polhode cache; expected one of clear"),
]


@pytest.mark.parametrize(("line", "said"), REFUSALS)
def test_bad_input_is_refused_in_one_line(polhode, tmp_path, line, said):
    out_folder = ("--out", str(tmp_path / "out")) if line.startswith("run rolling-disk ") else ()
    words = line.split()
    code, out, err = polhode(*words[:2], *out_folder, *words[2:])
    assert code == 2
    assert out == ""
    assert err.startswith("polhode: ")
    assert said in err
    assert err.count("\n") == 1
    assert not (tmp_path / "out").exists()


def test_no_command_shows_them_all(polhode):
    code, out, err = polhode()
    assert (code, out) == (2, "")
    assert "    invariants   first integrals of a system" in err.splitlines()
    assert polhode("help") == (0, err, "")


def test_help_on_a_command(polhode):
    assert polhode("help", "derive") == polhode("derive", "--help")


@pytest.mark.parametrize(
    "command", ["run gyroscope --duration 1e-3 --start", "steady gyroscope --at"]
)
def test_an_angle_that_looks_like_degrees_is_warned_of(polhode, command):
    said = "polhode: warning: theta = 80 is in radians; for degrees write 80deg\n"
    assert polhode(*command.split(), "theta=80")[::2] == (0, said)
    assert polhode(*command.split(), "theta=80deg")[::2] == (0, "")
    assert polhode(*command.split(), "phi_dot=80")[::2] == (0, "")


def test_so_is_the_end_of_an_axis(polhode, tmp_path):
    words = ["sweep", "gyroscope", "--duration", "1e-3", "--axis", "theta=1:80:2", "--out"]
    assert "for degrees write 80deg" in polhode(*words, str(tmp_path / "store"))[2]


def test_a_folder_that_cannot_be_made(polhode, tmp_path):
    (tmp_path / "file").write_text("kept")
    place = ("--out", str(tmp_path / "file"))
    code, out, err = polhode("run", "rolling-disk", "--duration", "0.1s", *place)
    assert (code, out) == (2, "")
    assert "cannot be created" in err
    assert (tmp_path / "file").read_text() == "kept"


@pytest.mark.parametrize("files", [("a\0b.tex",), ("a\0b.tex", "absent.tex")])
def test_a_name_of_a_file_with_a_null_character(polhode, files):
    code, out, err = polhode("review", *files)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "null" in err


def test_two_dashes_for_a_value_are_refused(polhode):
    code, _, err = polhode("check", "gyroscope", "F_z = M g", "--let=--")
    assert (code, err.count("\n")) == (2, 1)
    assert "-- where a value is expected" in err


@pytest.mark.parametrize(
    "words",
    [
        ("run", "marble-on-turntable", "--set", "g=" + "1" * 5000, "--duration", "0.1s"),
        ("check", "gyroscope", "F_z = M g", "--given", "I_1=" + "1" * 5000),
        ("check", "gyroscope", "F_z = M g", "--given", "I_1=M*" + "1" * 5000),
        ("steady", "gyroscope", "--at", "theta=" + "1" * 5000),
    ],
)
def test_numbers_of_thousands_of_digits_are_refused(polhode, words):
    code, _, err = polhode(*words)
    assert (code, err.count("\n")) == (2, 1)
    assert "characters" in err
    assert "report it" not in err
