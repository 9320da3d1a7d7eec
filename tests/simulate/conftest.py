import pytest


@pytest.fixture(params=["heyoka", "kernel"])
def integrator(request, monkeypatch):
    """Each integrator in turn."""
    if request.param == "heyoka":
        pytest.importorskip("heyoka")
    monkeypatch.setenv("POLHODE_INTEGRATOR", request.param)
    return request.param
