import pytest

from towtank.core.errors import ReadError
from towtank.formats.text_bytes import as_single_bytes, encoding_of, refuse_binary


@pytest.mark.parametrize(
    ("data", "encoding"),
    [
        (b"time;Fx", "utf-8"),
        ("Winkel °".encode(), "utf-8"),
        ("Winkel °".encode("utf-8-sig"), "utf-8-sig"),
        ("Winkel °".encode("latin-1"), "latin-1"),
        ("Winkel \u2013 °".encode("cp1252"), "cp1252"),
        (b"Winkel \x81 \xb0", "latin-1"),
        ("Winkel °".encode("utf-16"), "utf-16"),
    ],
)
def test_encoding_is_recognised(data, encoding):
    assert encoding_of(data) == encoding


def test_a_piece_may_end_within_a_character():
    assert encoding_of("Winkel °".encode()[:-1]) == "utf-8"


@pytest.mark.parametrize("data", [b"\x00\x01\x02\x03", b"abc\x00def", b"\x02\x03" * 50])
def test_binary_is_refused(data):
    with pytest.raises(ReadError, match=r"run.bin: is a binary file of an unknown kind -> export"):
        refuse_binary(data, "run.bin")


def test_text_with_utf16_is_not_binary():
    text = "t;Fx\r\n0;1\r\n".encode("utf-16")
    refuse_binary(text, "run.txt")
    assert as_single_bytes(text) == b"t;Fx\r\n0;1\r\n"
