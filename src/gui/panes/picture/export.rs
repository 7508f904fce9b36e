//! The picture and its heatmap as files.

use super::heat::HeatView;
use crate::gui::document::Document;
use crate::gui::edits::{Content, Export, MakeFile};
use crate::present::export::encoded;
use image::ImageFormat;

/// The picture as far as it is rendered.
pub fn picture(doc: &Document) -> Export {
    let content = match &doc.current {
        None => Content::Nothing("there is no picture yet".into()),
        Some(current) => {
            let picture = current.on_view().picture;
            let make: MakeFile = Box::new(move |extension| {
                encoded(&picture, format_of(extension)).map_err(|error| error.to_string())
            });
            Content::File(make)
        }
    };
    Export {
        name: "Picture",
        suffix: "",
        extensions: vec!["png", "exr"],
        content,
    }
}

/// The heatmap on view, with its legend.
pub fn heatmap(heat: &HeatView, doc: &Document) -> Export {
    let content = match heat.export(doc) {
        None => Content::Nothing("no heatmap is shown, or it is not there yet".into()),
        Some(sheet) => Content::File(Box::new(move |extension| sheet(format_of(extension)))),
    };
    Export {
        name: "Heatmap with its legend",
        suffix: "-heatmap",
        extensions: vec!["png", "exr"],
        content,
    }
}

fn format_of(extension: &str) -> ImageFormat {
    match extension {
        "exr" => ImageFormat::OpenExr,
        _ => ImageFormat::Png,
    }
}
