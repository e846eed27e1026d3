import pytest

from browser import Browser
from support import page


@pytest.fixture(params=[(1280, 900)], ids=lambda size: f"{size[0]} px wide")
def browser(request):
    opened = Browser(*request.param)
    opened.open(page.as_uri())
    yield opened
    opened.close()
