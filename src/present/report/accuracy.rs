//! Reports of the accuracy study: text for people, JSON and CSV for programs.

use super::table::plain_table;
use crate::measure::accuracy::{AccuracyStudy, Outcome};
use crate::present::number::{Digits, counted};
use serde_json::{Value, json};
use std::io::{Result, Write};

/// An accuracy study with the name of its scene.
pub struct AccuracyReport<'a> {
    pub scene: &'a str,
    pub study: &'a AccuracyStudy,
}

const TITLES: [&str; 12] = [
    "choice",
    "front",
    "time",
    "least",
    "most",
    "wrong hits",
    "RMSE",
    "max",
    "PSNR dB",
    "SSIM",
    "FLIP",
    "objects",
];

/// Writes two tables: choices that change the picture, and choices that change only its time.
///
/// # Errors
/// Those of `out`.
pub fn write_text(report: &AccuracyReport<'_>, out: &mut dyn Write) -> Result<()> {
    let study = report.study;
    if let Some(first) = study.outcomes.first() {
        let setup = &first.choice.setup;
        let render = &setup.render;
        writeln!(
            out,
            "Scene {}. Reference: f64, exact shapes, D_AREC {}, {} per pixel, {} × {} pixels, {}: \
             {} of CPU time,\nthe median of {}. Times are ratios to it. Errors are on linear light \
             from 0 to 1.",
            report.scene,
            render.d_arec,
            counted(render.samples as usize, "sample"),
            render.width,
            render.height,
            setup.build.method.name,
            Digits::Four.seconds(first.median()),
            counted(first.seconds.len(), "interleaved round")
        )?;
    }
    let rows = || study.outcomes.iter().zip(study.front()).enumerate();
    for (title, moves_image) in [
        ("What moves the picture", true),
        ("What moves only the time", false),
    ] {
        let mut table = plain_table(TITLES.map(String::from).to_vec(), 2);
        for (_, (outcome, front)) in
            rows().filter(|(i, (o, _))| *i == 0 || o.choice.moves_image == moves_image)
        {
            table.add_row(cells(study, outcome, front));
        }
        writeln!(out, "\n{title}\n{}", table.trim_fmt())?;
    }
    Ok(())
}

fn cells(study: &AccuracyStudy, outcome: &Outcome, front: bool) -> [String; 12] {
    let [least, median, most] = study.ratios(outcome);
    let error = &outcome.error;
    [
        outcome.choice.words(),
        if front { "front".into() } else { String::new() },
        Digits::Four.number(median),
        Digits::Four.number(least),
        Digits::Four.number(most),
        Digits::Four.percent(outcome.wrong_hits),
        Digits::Four.number(error.rmse),
        Digits::Four.number(error.max),
        error.psnr.map_or("∞".into(), |psnr| format!("{psnr:.1}")),
        format!("{:.5}", error.ssim),
        Digits::Four.number(error.flip),
        Digits::Four.bytes(outcome.object_bytes as f64),
    ]
}

/// Writes the study as one JSON document.
///
/// # Errors
/// Those of `out`.
pub fn write_json(report: &AccuracyReport<'_>, out: &mut dyn Write) -> Result<()> {
    let study = report.study;
    let outcomes: Vec<Value> = study
        .outcomes
        .iter()
        .zip(study.front())
        .map(|(outcome, front)| {
            let [least, median, most] = study.ratios(outcome);
            let turned = outcome.choice.turned.iter();
            let turned: serde_json::Map<_, _> = turned
                .map(|(knob, value)| (knob.clone(), json!(value)))
                .collect();
            json!({
                "turned": turned,
                "moves_image": outcome.choice.moves_image,
                "front": front,
                "seconds": outcome.seconds,
                "time_ratio": {"least": least, "median": median, "most": most},
                "wrong_hits": outcome.wrong_hits,
                "error": outcome.error,
                "object_bytes": outcome.object_bytes,
            })
        })
        .collect();
    let document = json!({"scene": report.scene, "outcomes": outcomes});
    serde_json::to_writer_pretty(&mut *out, &document)?;
    writeln!(out)
}

/// Writes one line per choice.
///
/// # Errors
/// Those of `out`.
pub fn write_csv(report: &AccuracyReport<'_>, out: &mut dyn Write) -> Result<()> {
    let study = report.study;
    let mut csv = csv::Writer::from_writer(out);
    csv.write_record([
        "scene",
        "choice",
        "moves_image",
        "front",
        "time_ratio",
        "time_ratio_least",
        "time_ratio_most",
        "wrong_hits",
        "rmse",
        "max",
        "psnr_db",
        "ssim",
        "flip",
        "object_bytes",
    ])?;
    for (outcome, front) in study.outcomes.iter().zip(study.front()) {
        let [least, median, most] = study.ratios(outcome);
        let error = &outcome.error;
        csv.write_record([
            report.scene.to_owned(),
            outcome.choice.words(),
            outcome.choice.moves_image.to_string(),
            front.to_string(),
            median.to_string(),
            least.to_string(),
            most.to_string(),
            outcome.wrong_hits.to_string(),
            error.rmse.to_string(),
            error.max.to_string(),
            error.psnr.map_or(String::new(), |psnr| psnr.to_string()),
            error.ssim.to_string(),
            error.flip.to_string(),
            outcome.object_bytes.to_string(),
        ])?;
    }
    csv.flush()
}
