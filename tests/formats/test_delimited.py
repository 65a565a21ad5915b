import numpy as np
import pytest

from towtank.core.errors import ReadError
from towtank.formats.delimited import read_delimited


@pytest.fixture
def read(tmp_path):
    def read_text(text, encoding="utf-8", **choices):
        path = tmp_path / "run.txt"
        path.write_bytes(text if isinstance(text, bytes) else text.encode(encoding))
        return read_delimited(path, **choices)

    return read_text


def rules(table):
    return [finding.rule for finding in table.findings]


@pytest.mark.parametrize("delimiter", ["\t", ";", "|", " ", "   "])
@pytest.mark.parametrize("decimal", [".", ","])
def test_values_units_header_and_metadata(read, delimiter, decimal):
    rows = [["0.05", "1.5", "-2.25"], ["0.10", "1.75", "-1e-3"], ["0.15", "2.5", "3"]]
    lines = ["# Run: 7", delimiter.join(["t", "Fx", "Mz"]), delimiter.join(["s", "N", "Nm"])]
    lines += [delimiter.join(row).replace(".", decimal) for row in rows]
    table = read("\n".join(lines) + "\n")
    np.testing.assert_array_equal(table.columns["t"], [0.05, 0.10, 0.15])
    np.testing.assert_array_equal(table.columns["Mz"], [-2.25, -1e-3, 3.0])
    assert table.units == {"t": "s", "Fx": "N", "Mz": "Nm"}
    assert table.header == tuple(lines[:3])
    assert table.metadata == {"Run": 7.0}
    assert table.findings == ()
    assert len(table.sha256) == 64


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "latin-1", "cp1252", "utf-16"])
def test_degree_sign_in_every_encoding(read, encoding):
    table = read("t;Drift\ns;°\n0;1,5\n1;2,5\n", encoding)
    assert table.units == {"t": "s", "Drift": "°"}
    assert table.columns["Drift"].tolist() == [1.5, 2.5]


def test_same_result_with_and_without_the_dialect(read):
    text = "# Run: 7\nt;Fx;Fy\ns;N;N\n0;1,5;2\n1;2,5;3\n"
    dialect = read(text).dialect
    again = read(text.replace("Run: 7", "Run: 8").replace("2,5", "4,5"), dialect=dialect)
    assert again.columns["Fx"].tolist() == [1.5, 4.5]
    assert again.metadata == {"Run": 8.0}
    assert again.dialect.names_row == 1


def test_dialect_of_other_headings_is_not_used(read):
    dialect = read("t;Fx\n0;1\n1;2\n").dialect
    table = read("t;Fy;Fx\n0;1;2\n1;2;3\n", dialect=dialect)
    assert table.columns["Fx"].tolist() == [2.0, 3.0]


def test_same_headings_but_decimal_comma_are_sniffed_again(read):
    dialect = read("t;Fx\n0.5;1.5\n1.5;2.5\n").dialect
    table = read("t;Fx\n0,5;1,5\n1,5;2,5\n", dialect=dialect)
    assert table.columns["Fx"].tolist() == [1.5, 2.5]


def test_decimal_comma_in_a_line_that_is_not_looked_at(read):
    rows = [f"{n}\t{n}" for n in range(5000)]
    rows[700] = "700\t0,5"
    assert read("t\tFx\n" + "\n".join(rows)).columns["Fx"][700] == 0.5
    rows[800] = "800\t0.5"
    with pytest.raises(ReadError, match=r"line 702, column Fx: '0,5' is not a number"):
        read("t\tFx\n" + "\n".join(rows))


def test_fault_is_reported_also_with_a_dialect(read):
    dialect = read("t;Fx\n0;1\n1;2\n").dialect
    with pytest.raises(ReadError, match=r"line 3, column Fx: 'x' is not a number"):
        read("t;Fx\n0;1\n1;x\n2;3\n", dialect=dialect)


def test_only_the_chosen_columns_are_read(read):
    table = read("t;Fx;Fy\ns;N;kN\n0;1;2\n1;2;3\n", columns=["Fy", 1])
    assert list(table.columns) == ["Fy", "t"]
    assert table.units == {"Fy": "kN", "t": "s"}
    assert table.file_columns == ("t", "Fx", "Fy")


def test_text_in_a_column_that_is_not_chosen_does_no_harm(read):
    text = "t;Fx;Fy\n0;1;2\n1;2;bad\n2;3;4\n3;4;5\n"
    assert read(text, columns=["t", "Fx"]).columns["Fx"].tolist() == [1.0, 2.0, 3.0, 4.0]
    with pytest.raises(ReadError, match=r"line 3, column Fy: 'bad' is not a number"):
        read(text)


def test_unknown_column(read):
    with pytest.raises(ReadError, match=r"there is no column 'Fz' -> closest: Fx.*; the file has t, Fx"):
        read("t;Fx\n0;1\n1;2\n", columns=["Fz"])


def test_cells_without_value_are_nan(read):
    table = read("t;Fx;Fy\n0;;2\n1;2;NaN\n2;  ;3\n3;4;\n")
    np.testing.assert_array_equal(table.columns["Fx"], [np.nan, 2, np.nan, 4])
    np.testing.assert_array_equal(table.columns["Fy"], [2, np.nan, 3, np.nan])
    assert table.findings == ()


def test_row_of_nan_is_kept_but_a_row_of_separators_is_blank(read):
    table = read("t;Fx\n0;1\nnan;nan\n;\n3;4\n")
    np.testing.assert_array_equal(table.columns["t"], [0, np.nan, 3])
    assert rules(table) == ["blank-rows"]
    assert table.findings[0].place == "line 4"


def test_blank_rows_are_dropped_with_a_finding(read):
    table = read("t;Fx\n0;1\n\n1;2\n\n\n2;3\n\n\n")
    assert table.columns["t"].tolist() == [0.0, 1.0, 2.0]
    assert rules(table) == ["blank-rows"]
    assert table.findings[0].place == "line 3"
    assert "3 blank row(s)" in table.findings[0].message


@pytest.mark.parametrize("last", ["3;4", "3;4.5;", "3;4.5;5.", "3;4;-", "3;4;1.5E"])
def test_cut_last_line(read, last):
    table = read(f"t;Fx;Fy\n0;1.5;2.5\n1;2.5;3.5\n2;3.5;4.5\n{last}")
    if last in ("3;4.5;", "3;4.5;5."):
        # Nothing tells these from an empty cell and a whole number.
        assert len(table) == 4
    else:
        assert len(table) == 3
        assert rules(table) == ["ragged-last-line"]
        assert table.findings[0].place == "line 5"
        assert table.findings[0].file.endswith("run.txt")


def test_ragged_line_in_the_middle(read):
    with pytest.raises(ReadError, match=r"run.txt, line 3: the line has 2 values where 3 columns are expected"):
        read("t;Fx;Fy\n0;1;2\n1;2\n2;3;4\n3;4;5\n")


def test_ragged_line_between_blanks_is_not_filled_up(read):
    with pytest.raises(ReadError, match=r"line 3: the line has 2 values"):
        read("t Fx Fy\n0 1 2\n1 1\n2 3 4\n")


def test_text_in_the_first_row_is_not_taken_for_a_header(read):
    with pytest.raises(ReadError, match=r"line 3, column t: 'abc' is not a number"):
        read("t;Fx\ns;N\nabc;1\n1;1\n2;3\n3;3\n")


def test_repeated_header_of_a_restarted_run(read):
    with pytest.raises(ReadError, match=r"line 4, column t: .* the header stands again, as after a restart"):
        read("t;Fx\n0;1\n1;2\nt;Fx\n1;2\n2;3\n")


def test_comment_between_the_data_is_dropped_with_a_finding(read):
    table = read("# Run: 1\nt;Fx\n0;1\n# restarted here\n1;2\n2;3\n")
    assert table.columns["Fx"].tolist() == [1.0, 2.0, 3.0]
    assert rules(table) == ["comment-in-data"]
    assert table.findings[0].place == "line 4"
    assert table.header[-1] == "# restarted here"


def test_refused_line_in_latin_1(read, capfd):
    with pytest.raises(ReadError, match="line 3: the line has 1 values"):
        read("t;Fx\n0;1\nmeßfehler °\n1;2\n2;3\n", "latin-1")
    assert capfd.readouterr().err == ""


def test_spellings_that_a_strict_parser_refuses(read):
    table = read("t,Fx,Fy\n0,1.5D+03,+2\n1,\u22122.5,1.#QNAN\n")
    assert table.columns["Fx"].tolist() == [1500.0, -2.5]
    np.testing.assert_array_equal(table.columns["Fy"], [2.0, np.nan])


def test_fixed_width_columns(read):
    lines = ["  t       Fx      Fy"]
    lines += [f"{n / 10:7.2f}{-12.3456 - n:9.4f}{-113.1111 - n:9.4f}" for n in range(20)]
    table = read("\n".join(lines))
    assert table.dialect.delimiter == "fixed"
    np.testing.assert_allclose(table.columns["Fx"], -12.3456 - np.arange(20), atol=1e-12)
    np.testing.assert_allclose(table.columns["Fy"], -113.1111 - np.arange(20), atol=1e-12)
    cut = read("\n".join([*lines, "   2.00 -12.3"]))
    assert len(cut) == 20
    assert rules(cut) == ["ragged-last-line"]


def test_fixed_width_with_a_blank_cell(read):
    lines = [f"{n / 10:8.2f}{12.5 + n:10.4f}{-n - 0.5:10.4f}" for n in range(20)]
    lines[15] = lines[15][:8] + " " * 10 + lines[15][18:]
    table = read("\n".join(["t Fx Fy", *lines]))
    assert np.flatnonzero(np.isnan(table.columns["Fx"])).tolist() == [15]
    assert table.columns["Fy"][15] == -15.5


def test_one_data_row(read):
    table = read("t;Fx\ns;N\n0,5;1,5\n")
    assert {name: values.tolist() for name, values in table.columns.items()} == {"t": [0.5], "Fx": [1.5]}


def test_one_row_without_header(read):
    table = read("0.5;1.5\n")
    assert table.columns["column_2"].tolist() == [1.5]
    assert rules(table) == ["names-fewer-than-columns"]


@pytest.mark.parametrize("text", ["t;Fx\n", "t;Fx\ns;N\n", "t;Fx\ns;N\n\n\n"])
def test_header_only(read, text):
    with pytest.raises(ReadError, match=r"run.txt: there are no data rows ->"):
        read(text)


def test_empty_and_binary(read):
    with pytest.raises(ReadError, match="the file is empty"):
        read(b"")
    with pytest.raises(ReadError, match="is a binary file of an unknown kind"):
        read(bytes(range(256)))


def test_findings_of_the_header_carry_the_file(read):
    table = read("t;Fx;Fx;note\ns;N;N\n0;1;2;a\n1;2;3;b\n")
    assert rules(table) == ["units-fewer-than-columns", "duplicate-columns", "text-column"]
    assert all(finding.file.endswith("run.txt") for finding in table.findings)
    assert list(table.columns) == ["t", "Fx", "Fx_2"]


def test_text_column_is_refused_when_chosen(read):
    with pytest.raises(ReadError, match="column 'note' holds text"):
        read("t;Fx;note\n0;1;a\n1;2;b\n", columns=["note"])


def test_old_macintosh_line_ends(read):
    table = read("t;Fx\r0;1\r\r1;2\r")
    assert table.columns["t"].tolist() == [0.0, 1.0]
    assert rules(table) == ["blank-rows"]
