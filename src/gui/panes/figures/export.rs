//! The final figures as files: a report in one of its formats, or an HTML page with pictures.

use crate::gui::document::{Current, Document};
use crate::gui::edits::{Content, Export, MakeFile};
use crate::measure::heat::PixelCounts;
use crate::present::export::write_page;
use crate::present::report::{Report, WRITERS};
use std::sync::Arc;

/// The counts of all pixels, of every run of a report.
type Counts = Vec<Option<Arc<PixelCounts>>>;

/// The figures, in any format of a report.
pub fn figures(doc: &Document, ctx: &egui::Context) -> Export {
    let make = report(doc, ctx).map(|(report, _)| {
        let make: MakeFile = Box::new(move |extension| {
            let writer = WRITERS.iter().find(|w| w.extension == extension);
            let writer = writer.ok_or("no such format")?;
            let mut bytes = Vec::new();
            (writer.write)(&report, &mut bytes).map_err(|error| error.to_string())?;
            Ok(bytes)
        });
        make
    });
    Export {
        name: "Figures",
        suffix: "-figures",
        extensions: WRITERS.iter().map(|writer| writer.extension).collect(),
        content: content(make),
    }
}

/// One HTML page: pictures, tables, settings, notes, machine.
pub fn page(doc: &Document, ctx: &egui::Context) -> Export {
    let make = report(doc, ctx).and_then(|(report, counts)| {
        let notes = doc.notes.clone();
        let current = doc.current.as_ref().ok_or("there is no picture")?;
        let picture = Arc::clone(&current.shown.picture);
        let make: MakeFile = Box::new(move |_| {
            let mut bytes = Vec::new();
            let counts: Vec<_> = counts.iter().map(Option::as_deref).collect();
            write_page(&report, &picture, &counts, &notes, &mut bytes)
                .map_err(|error| error.to_string())?;
            Ok(bytes)
        });
        Ok(make)
    });
    Export {
        name: "Report",
        suffix: "-report",
        extensions: vec!["html"],
        content: content(make),
    }
}

fn content(make: Result<MakeFile, String>) -> Content {
    match make {
        Ok(make) => Content::File(make),
        Err(why) => Content::Nothing(why),
    }
}

/// The final figures: of both trees where they may be compared, else of the one in front.
fn report(doc: &Document, ctx: &egui::Context) -> Result<(Report, Counts), String> {
    let verdict = doc.verdict(ctx);
    let may_compare = verdict.is_some_and(|verdict| verdict.reasons.is_empty());
    let shown: Vec<&Current> = match (doc.both(), may_compare) {
        ([Some(a), Some(b)], true) => vec![a, b],
        _ => doc.current.iter().collect(),
    };
    if !shown.iter().all(|current| current.complete) {
        return Err("the figures are not final yet".into());
    }
    let first = shown.first().ok_or("there are no figures yet")?;
    let runs = shown.iter().map(|c| c.shown.measurement.clone()).collect();
    let report = Report::new(&first.shown.scene, &first.shown.setup.scene, runs);
    let counts = shown.iter().map(|c| c.pixel_counts.clone()).collect();
    Ok((report, counts))
}
