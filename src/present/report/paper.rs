//! The paper's tables: printed figures next to computed ones.

use super::escape;
use super::grid::Grid;
use super::writer::Writer;
use crate::measure::paper::{CHARACTERISTICS, Cell, Mark, Reproduction};
use crate::measure::parameter;
use crate::present::words::printed_unit;
use serde_json::{Map, Value, json};
use std::io::{Result, Write};

/// All writers of reproductions, under the names of [`super::WRITERS`].
pub static PAPER_WRITERS: &[Writer<[Reproduction]>] = &[
    Writer {
        name: "text",
        about: "tables for reading on a terminal",
        extension: "txt",
        write: write_text,
    },
    Writer {
        name: "json",
        about: "for programs; shares in per cent, as they are printed",
        extension: "json",
        write: write_json,
    },
    Writer {
        name: "csv",
        about: "one line for every cell",
        extension: "csv",
        write: write_csv,
    },
    Writer {
        name: "markdown",
        about: "tables for issues and notes",
        extension: "md",
        write: write_markdown,
    },
    Writer {
        name: "latex",
        about: "tabular environments for papers",
        extension: "tex",
        write: write_latex,
    },
];

/// The titles of the columns of Tables 5 and 6.
pub const COLUMNS: [&str; 3] = ["1", "2", "2/1"];

const PAPER: &str = "V. Havran and J. Žára, Evaluation of BSP properties for ray-tracing";

/// Returns the explanation of the marks.
fn legend() -> String {
    let marks = [Mark::Equal, Mark::SameDirection, Mark::Differs];
    let marks = marks.map(|mark| format!("{} {}", mark.sign(), mark.name()));
    format!("Printed figures: {PAPER}. Marks: {}.", marks.join(", "))
}

fn write_text(results: &[Reproduction], out: &mut dyn Write) -> Result<()> {
    writeln!(out, "{}", legend())?;
    for grid in grids(results) {
        grid.write_text(out)?;
    }
    writeln!(out)?;
    remarks(results)
        .iter()
        .try_for_each(|remark| writeln!(out, "{remark}"))
}

fn write_markdown(results: &[Reproduction], out: &mut dyn Write) -> Result<()> {
    writeln!(out, "{}", escape::markdown(&legend()))?;
    for grid in grids(results) {
        grid.write_markdown(out)?;
    }
    writeln!(out)?;
    remarks(results)
        .iter()
        .try_for_each(|remark| writeln!(out, "- {}", escape::markdown(remark)))
}

fn write_latex(results: &[Reproduction], out: &mut dyn Write) -> Result<()> {
    writeln!(out, "% {}", legend())?;
    for remark in remarks(results) {
        writeln!(out, "% {remark}")?;
    }
    grids(results)
        .iter()
        .try_for_each(|grid| grid.write_latex(out))
}

/// Returns Table 4 of all scenes, then Table 5 or 6 of each scene.
fn grids(results: &[Reproduction]) -> Vec<Grid> {
    let mut grids = vec![table_4(results)];
    grids.extend(results.iter().map(properties));
    grids
}

fn table_4(results: &[Reproduction]) -> Grid {
    let mut grid = Grid {
        title: "Table 4: the scenes, printed and computed".into(),
        header: vec!["".into(), "".into()],
        first_number: 2,
        ..Grid::default()
    };
    for result in results {
        grid.header.push(result.scene.name.into());
        grid.header.extend(["computed".into(), "".into()]);
    }
    let columns: Vec<_> = results.iter().map(Reproduction::characteristics).collect();
    for (i, symbol) in CHARACTERISTICS.into_iter().enumerate() {
        let unit = printed_unit(parameter(symbol), false);
        let cells = columns.iter().flat_map(|rows| texts(&rows[i].cells[0]));
        let titles = [symbol.to_owned(), unit.to_owned()];
        grid.rows.push(titles.into_iter().chain(cells).collect());
    }
    grid
}

fn properties(result: &Reproduction) -> Grid {
    let scene = result.scene;
    let mut grid = Grid {
        title: format!(
            "Table {}: {}{}",
            scene.table,
            scene.name,
            if scene.published {
                ""
            } else {
                ", a reconstruction"
            }
        ),
        header: vec!["".into(), "".into()],
        first_number: 2,
        ..Grid::default()
    };
    for column in COLUMNS {
        grid.header
            .extend([column.into(), "computed".into(), "".into()]);
    }
    for row in result.properties() {
        let titles = [
            row.parameter.symbol.to_owned(),
            printed_unit(row.parameter, false).to_owned(),
        ];
        let cells = row.cells.iter().flat_map(texts);
        grid.rows.push(titles.into_iter().chain(cells).collect());
    }
    grid
}

fn texts(cell: &Cell) -> [String; 3] {
    [
        cell.printed.into(),
        cell.computed_text(),
        cell.mark.map_or("", Mark::sign).into(),
    ]
}

/// Returns the notes about scenes and cells, each only once.
fn remarks(results: &[Reproduction]) -> Vec<String> {
    let mut remarks = Vec::new();
    for result in results {
        let name = result.scene.name;
        remarks.extend(result.notes.iter().map(|note| format!("{name}: {note}")));
        for reason in result.unequal.iter().flatten() {
            remarks.push(format!(
                "{name}: methods 1 and 2 are not comparable: {reason}"
            ));
        }
    }
    let mut notes = Vec::<Note>::new();
    for result in results.iter().filter(|result| result.scene.published) {
        for (symbol, column, cell) in cells(result) {
            if let Some(text) = cell.note {
                let cell = column.map_or(symbol.into(), |column| format!("{symbol} {column}"));
                add_note(&mut notes, text, result.scene.name, cell);
            }
        }
    }
    remarks.extend(notes.into_iter().map(|note| {
        let [scenes, cells] = [note.scenes.join(", "), note.cells.join(", ")];
        format!("{scenes}: {cells}: {}", note.text)
    }));
    remarks
}

/// A note with its scenes and cells.
#[derive(Debug, PartialEq)]
struct Note {
    text: &'static str,
    scenes: Vec<&'static str>,
    cells: Vec<String>,
}

fn add_note(notes: &mut Vec<Note>, text: &'static str, scene: &'static str, cell: String) {
    let known = notes.iter_mut().find(|note| note.text == text);
    if let Some(note) = known {
        if !note.scenes.contains(&scene) {
            note.scenes.push(scene);
        }
        if !note.cells.contains(&cell) {
            note.cells.push(cell);
        }
    } else {
        notes.push(Note {
            text,
            scenes: vec![scene],
            cells: vec![cell],
        });
    }
}

/// Returns every cell with its symbol and the title of its column. Cells of Table 4 have no title.
fn cells(result: &Reproduction) -> Vec<(&'static str, Option<&'static str>, Cell)> {
    let characteristics = result.characteristics();
    let mut all: Vec<_> = characteristics
        .iter()
        .map(|row| (row.parameter.symbol, None, row.cells[0]))
        .collect();
    for row in result.properties() {
        for (column, cell) in COLUMNS.into_iter().zip(row.cells) {
            all.push((row.parameter.symbol, Some(column), cell));
        }
    }
    all
}

fn write_json(results: &[Reproduction], out: &mut dyn Write) -> Result<()> {
    let value = json!({
        "source": PAPER,
        "scenes": results.iter().map(scene).collect::<Vec<_>>(),
    });
    serde_json::to_writer_pretty(&mut *out, &value)?;
    writeln!(out)
}

fn scene(result: &Reproduction) -> Value {
    let table_4: Map<_, _> = result
        .characteristics()
        .iter()
        .map(|row| (row.parameter.symbol.into(), cell(&row.cells[0])))
        .collect();
    let properties: Map<_, _> = result
        .properties()
        .iter()
        .map(|row| {
            let cells: Map<_, _> = COLUMNS
                .into_iter()
                .zip(&row.cells)
                .map(|(column, of)| (column.into(), cell(of)))
                .collect();
            (row.parameter.symbol.into(), Value::Object(cells))
        })
        .collect();
    let unequal = result.unequal.as_ref();
    let run = result.runs.iter().flatten().next();
    json!({
        "name": result.scene.name,
        "geometry": result.scene.geometry,
        "reconstruction": !result.scene.published,
        "notes": result.notes,
        "resolution": run.map(|run| [run.render.width, run.render.height]),
        "sampling": run.map(|run| run.render.sampling),
        "cylinders": "polygons:10",
        "unequal": unequal.map(|all| all.iter().map(ToString::to_string).collect::<Vec<_>>()),
        "table_4": table_4,
        "table": result.scene.table,
        "properties": properties,
    })
}

fn cell(cell: &Cell) -> Value {
    json!({
        "printed": cell.printed,
        "computed": cell.computed,
        "mark": cell.mark.map(Mark::name),
        "note": cell.note,
    })
}

fn write_csv(results: &[Reproduction], out: &mut dyn Write) -> Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record([
        "scene", "table", "symbol", "column", "unit", "printed", "computed", "mark", "note",
    ])?;
    for result in results {
        for (symbol, column, cell) in cells(result) {
            let table = column.map_or(4, |_| result.scene.table);
            let unit = printed_unit(parameter(symbol), column == Some("2/1"));
            csv.write_record([
                result.scene.name,
                &table.to_string(),
                symbol,
                column.unwrap_or(""),
                unit,
                cell.printed,
                &cell
                    .computed
                    .map_or(String::new(), |value| value.to_string()),
                cell.mark.map_or("", Mark::name),
                cell.note.unwrap_or(""),
            ])?;
        }
    }
    csv.flush()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::present::report::WRITERS;

    #[test]
    fn reproductions_are_written_in_every_form_of_a_report() {
        let names: Vec<_> = WRITERS.iter().map(|w| (w.name, w.extension)).collect();
        let of_paper: Vec<_> = PAPER_WRITERS
            .iter()
            .map(|w| (w.name, w.extension))
            .collect();
        assert_eq!(of_paper, names);
    }

    #[test]
    fn a_note_stands_once_with_all_that_it_is_about() {
        let mut notes = Vec::new();
        for (text, scene, cell) in [("x", "a", "1"), ("y", "a", "1"), ("x", "b", "1")] {
            add_note(&mut notes, text, scene, cell.into());
        }
        assert_eq!(notes.len(), 2);
        assert_eq!(notes[0].scenes, ["a", "b"]);
        assert_eq!(notes[0].cells, ["1"]);
    }
}
