//! A report as one self-contained HTML file: pictures, tables, settings, machine.

use super::content::Report;
use super::exact::exact_value;
use super::machine::Machine;
use super::sections::{Section, delta_and_lambda, rows, tables, value_titles};
use super::words;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use std::io::{Result, Write};

/// The content of the page.
pub struct Page<'a> {
    pub report: &'a Report,
    pub figures: Vec<Figure>,
    pub machine: Machine,
    /// Date and time of the report ([`super::now`]).
    pub date: String,
    /// The user's notes; may be empty.
    pub notes: String,
    /// Commands that repeat the measurements, one per line.
    pub commands: Vec<String>,
}

/// A picture with its caption.
pub struct Figure {
    pub caption: String,
    /// The bytes of a PNG file.
    pub png: Vec<u8>,
}

const STYLE: &str = "
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1, h2 { line-height: 1.2; }
h2 { margin-top: 2.5rem; break-after: avoid; }
figure { display: inline-block; vertical-align: top; margin: 0 1rem 1rem 0; max-width: 46%; break-inside: avoid; }
figure img { max-width: 100%; height: auto; border: 1px solid #8888; }
figcaption, .soft { color: light-dark(#555, #aaa); font-size: 0.9rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 0.15rem 0.7rem 0.15rem 0; border-bottom: 1px solid #8884; }
thead th { border-bottom: 2px solid #8888; }
.number { text-align: right; white-space: nowrap; }
tr { break-inside: avoid; }
pre { white-space: pre-wrap; overflow-wrap: anywhere; background: #8882; padding: 0.6rem; }
dl { display: grid; grid-template-columns: max-content 1fr; gap: 0.2rem 1rem; }
dd { margin: 0; }
@media (max-width: 40rem) { figure { max-width: 100%; } }
@media print { :root { color-scheme: light; } body { max-width: none; font-size: 11px; margin: 0; } }
";

impl Page<'_> {
    /// Writes the page.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn write(&self, out: &mut dyn Write) -> Result<()> {
        out.write_all(self.markup().into_string().as_bytes())
    }

    fn markup(&self) -> Markup {
        let report = self.report;
        let title = format!("{}: BSP trees measured", report.scene.name);
        html! {
            (DOCTYPE)
            html lang="en" {
                head {
                    meta charset="utf-8";
                    meta name="viewport" content="width=device-width, initial-scale=1";
                    meta name="generator" content=(self.machine.version);
                    title { (title) }
                    style { (PreEscaped(STYLE)) }
                }
                body {
                    h1 { (title) }
                    p.soft { (self.machine.version) ", " (self.date) }
                    @if !self.notes.trim().is_empty() {
                        h2 { "Notes" }
                        pre { (self.notes) }
                    }
                    h2 { "Scene" }
                    (list(&words::scene(report)))
                    @if !self.figures.is_empty() {
                        h2 { "Pictures" }
                        @for figure in &self.figures { (figure.markup()) }
                    }
                    @for section in delta_and_lambda(report) { (table(&section, report)) }
                    (list(&words::times(report)))
                    h2 { "Settings" }
                    (list(&words::settings(report)))
                    p { "The same again:" }
                    pre { (self.commands.join("\n")) }
                    h2 { "Machine" }
                    (self.machine.markup())
                    h2 { "All parameters" }
                    p.soft {
                        "Symbols and tables are those of V. Havran and J. Žára, “Evaluation of BSP \
                         properties for ray-tracing”. Class S is given, D follows from scene and \
                         picture, C is of the tree, R of the rays, T a time of this machine."
                    }
                    @for section in tables() { (table(&section, report)) }
                }
            }
        }
    }
}

impl Figure {
    fn markup(&self) -> Markup {
        let data = format!("data:image/png;base64,{}", STANDARD.encode(&self.png));
        html! {
            figure {
                img src=(data) alt=(self.caption);
                figcaption { (self.caption) }
            }
        }
    }
}

impl Machine {
    fn markup(&self) -> Markup {
        let facts = [
            ("Processor", &self.processor),
            ("Cores", &self.cores),
            ("Memory", &self.memory),
            ("System", &self.system),
            ("Version", &self.version),
        ];
        html! {
            dl { @for (name, value) in facts { dt { (name) } dd { (value) } } }
        }
    }
}

fn list(lines: &[String]) -> Markup {
    html! { ul { @for line in lines { li { (line) } } } }
}

fn table(section: &Section, report: &Report) -> Markup {
    html! {
        h2 { (section.title) }
        div.wide {
            table {
                thead {
                    tr {
                        th { "symbol" } th { "name" } th { "class" } th { "unit" }
                        @for title in value_titles(report) { th.number { (title) } }
                    }
                }
                tbody {
                    @for row in rows(section, report) {
                        tr {
                            th scope="row" { code { (row.parameter.symbol) } }
                            td title=(row.parameter.meaning) { (row.parameter.name) }
                            td { (format!("{:?}", row.parameter.class)) }
                            td { (row.unit()) }
                            @for (run, value) in report.runs.iter().zip(&row.values) {
                                td.number {
                                    // The exact value, as in the JSON report.
                                    data value=(exact_value(row.parameter, run)) { (value) }
                                }
                            }
                            @if let Some(change) = &row.second_to_first { td.number { (change) } }
                        }
                    }
                }
            }
        }
    }
}
