"""Bad input: one clear line, exit code 2, nothing on standard output and nothing written."""

import pytest

REFUSALS = [
    ("list --jso", "unrecognized arguments: --jso"),
    ("nothing", "invalid choice: 'nothing'"),
    ("", "the following arguments are required: COMMAND"),
    ("derive", "the following arguments are required: NAME"),
    ("derive rolling-disc", "did you mean rolling-disk"),
    ("derive a b", "unrecognized arguments: b"),
    ("run", "see 'polhode run --help'"),
    ("run rolling-disk --pages x.html", "unrecognized arguments: --pages x.html"),
    ("run rolling-disk --mu -0.1", "friction coefficient of contact 'ground': -1/10"),
    ("run rolling-disk --mu 0.3 --mu-static 0.2", "mu = 3/10 above mu_static = 1/5"),
    ("run rolling-disk --mu-static 0.2", "--mu-static without --mu"),
    ("run gyroscope --mu 0.2", "friction for 'gyroscope', in which nothing touches a support"),
    ("run rolling-disk --sheet nowhere.csv", "a sheet for 'rolling-disk'"),
    ("run rolling-disk --dur 1s", "unrecognized arguments: --dur 1s"),
    ("run rolling-disk --set", "argument --set: expected one argument"),
    ("run rolling-disk --set m", "'m'; expected name=value"),
    ("run rolling-disk --set =1", "expected name=value"),
    ("run rolling-disk --set m=", "expected name=value"),
    ("run rolling-disk --set m=1 --set m=2", "m is given twice"),
    ("run rolling-disk --set m=-1", "m = -1; expected a positive value"),
    ("run rolling-disk --set m=0", "m = 0; expected a positive value"),
    ("run rolling-disk --set m=nan", "m: 'nan' is not a value; expected a finite number"),
    ("run rolling-disk --set m=inf", "expected a finite number"),
    ("run rolling-disk --set m=1e999kg", "expected a finite number"),
    ("run rolling-disk --set m=1e308", "not finite"),
    ("run rolling-disk --set m=3m", "m = '3m' is a quantity in m; expected a quantity in kg"),
    ("run rolling-disk --set M=1", "'M' is no parameter of rolling-disk; expected one of m, a, g"),
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
    ("cache", "the following arguments are required"),
    ("cache empty", "invalid choice: 'empty'"),
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


def test_a_folder_that_cannot_be_made(polhode, tmp_path):
    (tmp_path / "file").write_text("kept")
    place = ("--out", str(tmp_path / "file"))
    code, out, err = polhode("run", "rolling-disk", "--duration", "0.1s", *place)
    assert (code, out) == (2, "")
    assert "cannot be created" in err
    assert (tmp_path / "file").read_text() == "kept"


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
