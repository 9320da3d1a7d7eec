"""`polhode export`: source code on the terminal or in a file, and refusals."""


def test_source_on_the_terminal_and_in_a_file(polhode, document, tmp_path):
    code, out, _ = polhode("export", "tennis-racquet", "--to", "julia")
    assert code == 0
    assert "function rates!(out, x, p, t)" in out
    file = tmp_path / "racquet.jl"
    found = document("export", "tennis-racquet", "--to", "julia", "-o", str(file))
    assert found["file"] == str(file)
    assert found["to"] == "julia"
    assert file.read_text() == out.removesuffix("\n")
    assert document("export", "tennis-racquet", "--to", "c")["source"].startswith("// ")


def test_refusals(polhode, tmp_path):
    code, out, err = polhode("export", "tennis-racquet", "--to", "cobol")
    assert (code, out) == (2, "")
    assert "numpy" in err
    code, out, err = polhode("export", "tennis-racquet", "--to", "c", "-o", str(tmp_path))
    assert (code, out) == (2, "")
    assert err.count("\n") == 1


def test_a_kernel_goes_to_a_file(polhode, document, tmp_path):
    file = tmp_path / "racquet.wasm"
    found = document("export", "tennis-racquet", "--to", "wasm", "-o", str(file))
    assert found["file"] == str(file)
    content = file.read_bytes()
    assert content[:4] == b"\0asm"
    assert b'"system": "tennis-racquet"' in content
    code, out, err = polhode("export", "tennis-racquet", "--to", "wasm")
    assert (code, out) == (2, "")
    assert "-o tennis-racquet.wasm" in err
