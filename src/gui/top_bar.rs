//! The bar at the top: scene, method, D_MAX, N_OILF, D_AREC, and what is being worked on.

use super::comparing::Which;
use super::files::Files;
use super::shortcuts::{Action, choose, text, tip};
use super::state::{State, Work};
use crate::measure::parameter;
use crate::structure::{MaxDepth, Method};

/// The most that the window lets secondary rays recurse.
pub const MOST_RECURSION: u32 = 50;

/// Shows the bar.
pub fn show(ui: &mut egui::Ui, state: &mut State, files: &mut Files, help: &mut bool) {
    ui.horizontal_wrapped(|ui| {
        files.ui(ui, state);
        if ui
            .button("Shortcuts ?")
            .on_hover_text(tip("Show or hide all shortcuts.", Action::Help))
            .clicked()
        {
            *help = !*help;
        }
        if ui
            .button("Lessons")
            .on_hover_text(tip(
                "Guided tours that ask for a prediction, then show.",
                Action::Lessons,
            ))
            .clicked()
        {
            choose(ui.ctx(), Action::Lessons);
        }
        view_menu(ui);
        let dark = ui.visuals().dark_mode;
        if ui
            .button(if dark { "Light" } else { "Dark" })
            .on_hover_text(tip("Light or dark window.", Action::Theme))
            .clicked()
        {
            toggle_theme(ui.ctx());
        }
    });
    ui.horizontal_wrapped(|ui| {
        which(ui, state);
        method(ui, state);
        ui.separator();
        d_max(ui, state);
        n_oilf(ui, state);
        d_arec(ui, state);
        ui.separator();
        work(ui, state);
    });
}

/// What is done to the window as a whole.
fn view_menu(ui: &mut egui::Ui) {
    ui.menu_button("View", |ui| {
        for (name, action) in [
            ("Search for a command…", Action::Palette),
            ("Left bar", Action::LeftBar),
            ("Right bar", Action::RightBar),
            ("Reset the layout", Action::ResetLayout),
        ] {
            let item = egui::Button::new(name).shortcut_text(text(action));
            if ui.add(item).clicked() {
                choose(ui.ctx(), action);
            }
        }
    })
    .response
    .on_hover_text("Commands, bars and the layout of the panes");
}

/// From dark to light and back.
pub fn toggle_theme(ctx: &egui::Context) {
    set_theme(ctx, ctx.theme() == egui::Theme::Light);
}

pub fn set_theme(ctx: &egui::Context, dark: bool) {
    ctx.set_theme(if dark {
        egui::ThemePreference::Dark
    } else {
        egui::ThemePreference::Light
    });
}

/// Which of two compared trees the settings are about.
fn which(ui: &mut egui::Ui, state: &mut State) {
    let comparing = state.other.is_some();
    let about = "Compare with another tree of the same scene, or end that with the one in front.";
    if ui
        .add(egui::Button::new("Compare").selected(comparing))
        .on_hover_text(tip(about, Action::Compare))
        .clicked()
    {
        state.compare_or_not();
    }
    if comparing {
        for which in Which::BOTH {
            let about = format!(
                "Bring tree {} to the front: settings and panels are about it.",
                which.name()
            );
            let name = format!("Tree {}", which.name());
            if ui
                .add(egui::Button::new(name).selected(state.which == which))
                .on_hover_text(tip(&about, Action::OtherTree))
                .clicked()
            {
                state.show(which);
            }
        }
    }
    ui.separator();
}

fn method(ui: &mut egui::Ui, state: &mut State) {
    let method = state.wanted.build.method;
    egui::ComboBox::from_id_salt("method")
        .selected_text(format!("Method: {}", method.name))
        .width(150.0)
        .show_ui(ui, |ui| {
            for other in Method::all() {
                let item = ui.selectable_label(other == method, other.title);
                let item = item.on_hover_text(format!("{}\nSource: {}", other.about, other.source));
                if item.clicked() {
                    state.wanted.build.set_method(other);
                }
            }
        })
        .response
        .accessible_name("Build method")
        .on_hover_text(tip(
            &format!("{}\n{}", method.title, method.about),
            Action::NextMethod,
        ));
}

fn d_max(ui: &mut egui::Ui, state: &mut State) {
    let automatic = state.wanted.build.d_max == MaxDepth::Automatic;
    let about = about("D_MAX", Action::Deeper);
    ui.label("D_MAX").on_hover_text(&about);
    // While automatic, the number says what that came to in the tree on view.
    let resolved = state
        .current
        .as_ref()
        .map_or(0, |c| c.shown.tree.depth_limit());
    let mut depth = match state.wanted.build.d_max {
        MaxDepth::Fixed(depth) => depth,
        MaxDepth::Automatic => resolved,
    };
    ui.spacing_mut().slider_width = 80.0;
    let slider = egui::Slider::new(&mut depth, 0..=MaxDepth::LIMIT);
    let changed = ui
        .name_inputs("D_MAX", |ui| ui.add_enabled(!automatic, slider))
        .on_hover_text(&about)
        .changed();
    if changed && !automatic {
        state.wanted.build.d_max = MaxDepth::Fixed(depth);
    }
    let mut auto = automatic;
    ui.checkbox(&mut auto, "auto")
        .on_hover_text(tip("D_MAX = 1.2 log2 N_O + 2, rounded.", Action::AutoDepth));
    if auto != automatic {
        toggle_automatic(state);
    }
}

/// Between an automatic `D_MAX` and the number it came to.
pub fn toggle_automatic(state: &mut State) {
    let resolved = state
        .current
        .as_ref()
        .map_or(20, |c| c.shown.tree.depth_limit());
    let d_max = &mut state.wanted.build.d_max;
    *d_max = match d_max {
        MaxDepth::Automatic => MaxDepth::Fixed(resolved),
        MaxDepth::Fixed(_) => MaxDepth::Automatic,
    };
}

fn n_oilf(ui: &mut egui::Ui, state: &mut State) {
    let about = about("N_OILF", Action::MoreInLeaf);
    ui.label("N_OILF").on_hover_text(&about);
    let edit = egui::DragValue::new(&mut state.wanted.build.n_oilf)
        .range(0..=10_000)
        .speed(0.1);
    ui.add(edit).accessible_name("N_OILF").on_hover_text(&about);
}

fn d_arec(ui: &mut egui::Ui, state: &mut State) {
    let about = about("D_AREC", Action::MoreRecursion);
    ui.label("D_AREC").on_hover_text(&about);
    let edit = egui::DragValue::new(&mut state.wanted.render.d_arec)
        .range(0..=MOST_RECURSION)
        .speed(0.05);
    ui.add(edit).accessible_name("D_AREC").on_hover_text(&about);
}

/// The tooltip of a setting that is one of the paper's parameters.
fn about(symbol: &str, action: Action) -> String {
    let p = parameter(symbol);
    tip(
        &format!(
            "{}: {}\n{}\nClass {:?} · {}",
            p.symbol,
            p.name,
            p.meaning,
            p.class,
            p.table.title()
        ),
        action,
    )
}

/// The picture's stage, how far it is, and a way to cancel it.
fn work(ui: &mut egui::Ui, state: &mut State) {
    let status = state.work.as_ref().and_then(Work::status);
    let (fraction, label) = match &status {
        Some(status) => (status.fraction as f32, status.stage.clone()),
        None if state.stopped => (0.0, "cancelled".to_owned()),
        None => (1.0, "ready".to_owned()),
    };
    let working = state.work.is_some();
    let percent = (fraction * 100.0).round();
    let shown = match &state.work {
        Some(work) if state.other.is_some() => {
            format!("{}: {label} {percent} %", work.which.name())
        }
        Some(_) => format!("{label} {percent} %"),
        None => label,
    };
    let bar = egui::ProgressBar::new(fraction).desired_width(190.0);
    ui.add(bar.text(shown));
    if working {
        // Jobs wake the window for results; progress in between is worth a look now and then.
        ui.ctx().request_repaint_after_secs(0.1);
    }
    if state.stopped {
        if ui
            .button("Resume")
            .on_hover_text(tip("Start again what was cancelled.", Action::Again))
            .clicked()
        {
            state.again();
        }
    } else if ui
        .add_enabled(working, egui::Button::new("Cancel"))
        .on_hover_text(format!(
            "Stop; what is shown stays.\nShortcut: {}",
            text(Action::Cancel)
        ))
        .clicked()
    {
        state.cancel();
    }
}
