"""What `polhode lab` refuses before it serves anything; what it serves is tested in tests/lab."""

import socket

import pytest

from polhode.cli import main


@pytest.mark.parametrize("port", ["abc", "-1", "65536", "000000999999", "80a", "٣"])
def test_an_invalid_port_is_refused(port, capsys):
    assert main(["lab", "--no-browser", "--port", port]) == 2
    assert "--port" in capsys.readouterr().err


def test_a_port_in_use_is_reported(capsys):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        port = taken.getsockname()[1]
        assert main(["lab", "--no-browser", "--port", str(port)]) == 2
    assert f"port {port} of this machine" in capsys.readouterr().err


def test_a_missing_file_is_reported(capsys):
    assert main(["lab", "--no-browser", "nowhere.py:swing"]) == 2
    assert "nowhere.py" in capsys.readouterr().err
