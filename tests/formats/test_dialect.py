import pytest

from towtank.core.errors import ReadError
from towtank.formats.dialect import FIXED, sniff

ROWS = [(0.0, 1.5, -2.25), (0.1, 1.6, -2.5), (0.2, 1.7, -3.25), (0.3, 1.8, -3.5)]


def table(delimiter, decimal=".", head=("t", "Fx", "Fy"), end="\n"):
    lines = [delimiter.join(head)] if head else []
    lines += [delimiter.join(f"{value:.4f}".replace(".", decimal) for value in row) for row in ROWS]
    return (end.join(lines) + end).encode()


@pytest.mark.parametrize("delimiter", ["\t", ";", "|", " "])
@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_separator_and_decimal_sign(delimiter, decimal, end):
    found = sniff(table(delimiter, decimal, end=end))
    assert (found.delimiter, found.decimal) == (delimiter, decimal)
    assert found.names == ("t", "Fx", "Fy")
    assert (found.header_rows, found.names_row, found.units_row, found.first_data_row) == (1, 0, None, 1)


def test_comma_separated():
    assert (sniff(table(",")).delimiter, sniff(table(",")).decimal) == (",", ".")


def test_comma_separated_integers_are_not_one_decimal_column():
    found = sniff(b"t,n\n0,1\n1,2\n2,3\n")
    assert (found.delimiter, found.names) == (",", ("t", "n"))


def test_single_column_with_decimal_comma():
    found = sniff(b"Fx\n1,5\n2,5\n3,5\n")
    assert (found.decimal, found.names) == (",", ("Fx",))


def test_quoted_decimal_commas_in_a_comma_separated_file():
    found = sniff(b'"t","Fx"\n"0,1","1,5"\n"0,2","1,6"\n')
    assert (found.delimiter, found.decimal, found.names) == (",", ",", ("t", "Fx"))


def test_column_without_values_is_kept_between_tabs():
    found = sniff(b"t\tFx\tdead\tFy\n0\t1\t\t3\n1\t1\t\t3\n2\t1\t\t3\n")
    assert (found.delimiter, found.names) == ("\t", ("t", "Fx", "dead", "Fy"))


def test_blanks_round_tabs_do_not_hide_them():
    found = sniff(b"t \tFx \tFy \t\r\ns \tN \tN \t\r\n0.1 \t2.0\t3.0\r\n0.2 \t2.0\t3.0\r\n")
    assert found.delimiter == "\t"
    assert found.names == ("t", "Fx", "Fy")
    assert found.units == ("s", "N", "N")
    assert not found.trailing


def test_trailing_separator_is_no_column():
    found = sniff(b"t;Fx;\n0;1;\n1;2;\n2;3;\n")
    assert (found.names, found.trailing, found.width) == (("t", "Fx"), True, 3)


def test_aligned_table_with_names_of_two_words_and_units():
    text = "Lab: Tank 2\n\nZeit   Kraft vorn   Kraft achtern\n[s]    [N]          [N]\n" + "".join(
        f"{n / 100:.2f}   1.25         -3.50\n" for n in range(9)
    )
    found = sniff(text.encode())
    assert (found.delimiter, found.names) == (" ", ("Zeit", "Kraft vorn", "Kraft achtern"))
    assert found.units == ("s", "N", "N")
    assert found.metadata == {"Lab": "Tank 2"}
    assert (found.header_rows, found.first_data_row) == (2, 4)


def test_names_with_units_behind_them_between_blanks():
    found = sniff(b"t [s]  Fx [N]   Mz [N m]\n 0.1   2 3\n 0.2  3  4\n")
    assert (found.names, found.units) == (("t", "Fx", "Mz"), ("s", "N", "N m"))


def test_fixed_width_with_touching_numbers():
    lines = ["  t       Fx      Fy", *(f"{n / 10:7.2f}{-12.3456:8.4f}{-13.1111 - n:9.4f}" for n in range(8))]
    found = sniff("\n".join(lines).encode())
    assert found.delimiter == FIXED
    assert found.names == ("t", "Fx", "Fy")
    assert found.split(lines[1]) == ["0.00", "-12.3456", "-13.1111"]


@pytest.mark.parametrize("mark", ["#", "%", "!", "//", ";"])
def test_comment_lines(mark):
    text = f"{mark} Run: 12\n{mark} Speed = 1.53 m/s\n{mark} t, Fx\n{mark} s, N\n0.1,2\n0.2,3\n"
    found = sniff(text.encode())
    assert found.comment == mark
    assert found.metadata == {"Run": 12.0, "Speed": "1.53 m/s"}
    assert (found.names, found.units) == (("t", "Fx"), ("s", "N"))


def test_labview_measurement_file():
    head = (
        "LabVIEW Measurement\t\nWriter_Version\t2\n***End_of_Header***\t\n\t\nChannels\t2\t\t\nSamples\t20\t20\t\n"
        "X_Dimension\tTime\tTime\t\nX0\t0.0E+0\t0.0\t\nDelta_X\t0.05\t0.05\t\n***End_of_Header***\t\t\t\n"
        "X_Value\tFx\tFy\tComment\n"
    )
    found = sniff((head + "".join(f"{n / 20}\t1.5\t2.5\n" for n in range(20))).encode())
    assert found.names == ("X_Value", "Fx", "Fy")
    assert found.first_data_row == 11
    assert found.metadata["Writer_Version"] == 2.0


@pytest.mark.parametrize(
    ("encoding", "said"),
    [("utf-8", "utf-8"), ("utf-8-sig", "utf-8-sig"), ("latin-1", "latin-1"), ("cp1252", "cp1252")],
)
def test_encodings(encoding, said):
    sign = "\u2013" if encoding == "cp1252" else "\u00fc"
    text = f"Zeit;Kr{sign}ngung\ns;°\n0,1;2,5\n0,2;3,5\n"
    found = sniff(text.encode(encoding))
    assert found.encoding == said
    assert found.names == ("Zeit", f"Kr{sign}ngung")
    assert found.units == ("s", "°")


def test_long_preamble_and_middle_of_the_file_are_looked_at():
    preamble = "".join(f"remark number {n} of many words\n" for n in range(300))
    # The first samples are whole numbers; only later rows show the decimal comma.
    rows = "".join("0\t0\n" for _ in range(20000)) + "".join("0,5\t1,5\n" for _ in range(40000))
    found = sniff((preamble + "t\tFx\n" + rows).encode())
    assert (found.decimal, found.names, found.first_data_row) == (",", ("t", "Fx"), 301)


def test_adapted_to_a_file_with_another_run_number():
    first = b"# Run: 1\nt;Fx\ns;N\n0;1\n1;2\n"
    second = b"# Run: 12\nt;Fx\ns;N\n0;3\n1;4\n"
    dialect = sniff(first)
    assert dialect.adapt(first) is dialect
    other = dialect.adapt(second)
    assert other is not None
    assert other.metadata == {"Run": 12.0}
    assert second[len(other.head) :] == b"0;3\n1;4\n"
    assert other.header == ("# Run: 12", "t;Fx", "s;N")


def test_not_adapted_to_other_headings():
    dialect = sniff(b"t;Fx\ns;N\n0;1\n1;2\n")
    assert dialect.adapt(b"t;Fx\ns;kN\n0;1\n1;2\n") is None
    assert dialect.adapt(b"t;Fx\n") is None
    assert sniff(b"0;1\n1;2\n").adapt(b"0;1\n1;2\n") is None


@pytest.mark.parametrize(
    ("data", "fault"),
    [
        (b"", "the file is empty"),
        (b" \n\n", "the file is empty"),
        (b"t;Fx\ns;N\n", "there are no data rows"),
        (b"t,Fx,Fy\n0,1\n1,2\n", "the header names 3 columns but the rows have 2 values"),
        (b"\x00\x01\x02binary", "is a binary file"),
    ],
)
def test_files_that_are_no_table(data, fault):
    with pytest.raises(ReadError, match=f"run.txt.*: {fault}"):
        sniff(data, "run.txt")
