//! Small pieces that several panes share.

/// What is shown while facts of the tree are being worked out.
pub fn waiting(ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        ui.spinner();
        ui.label("Working out the facts of the tree …");
    });
}

/// Returns a name as it begins a line: with a capital, except for a symbol or a unit.
pub fn sentence(name: &str) -> String {
    let mut rest = name.chars();
    let first = rest.next().filter(char::is_ascii_lowercase);
    first.map_or_else(
        || name.to_owned(),
        |first| format!("{}{}", first.to_ascii_uppercase(), rest.as_str()),
    )
}

/// A number in few characters.
pub fn short(value: f64) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-3..1e5).contains(&size) {
        format!("{value:.2e}")
    } else if size >= 100.0 {
        format!("{value:.1}")
    } else {
        format!("{value:.3}")
    }
}

/// The least 1, 2 or 5 times a power of ten that is at least this.
pub fn nice_step(least: f64) -> f64 {
    let power = libm::exp10(least.max(f64::MIN_POSITIVE).log10().floor());
    let steps = [1.0, 2.0, 5.0].map(|of| of * power);
    steps
        .into_iter()
        .find(|&step| step >= least)
        .unwrap_or(10.0 * power)
}
