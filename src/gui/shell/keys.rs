//! Which actions the keys of a frame ask for.

use crate::gui::action::{Info, Scope};
use egui::Modifiers;

/// Where keys go.
#[derive(Clone, Copy, Default)]
struct Focus {
    /// To any widget.
    widget: bool,
    /// To one that text is typed into.
    text: bool,
}

impl Focus {
    fn of(ctx: &egui::Context) -> Self {
        Focus {
            widget: ctx.egui_wants_keyboard_input(),
            text: ctx.text_edit_focused(),
        }
    }

    /// Where it is noted.
    fn id() -> egui::Id {
        egui::Id::unique("focus as the frame began")
    }
}

/// Notes where keys go as a frame begins. In a slow frame a text and the Enter that ends it arrive
/// together: panes, which ask later, must not take its letters for shortcuts.
pub fn note_focus(ctx: &egui::Context) {
    let focus = Focus::of(ctx);
    ctx.data_mut(|data| data.insert_temp(Focus::id(), focus));
}

/// Returns the places in `actions` that the keys of this frame ask for, of one scope. Keys with more
/// modifiers come first: a shortcut without Shift would take a key with Shift, too. Plain keys belong to
/// the focused widget, the open list, or the question that stands before the window, if there is one.
pub fn pressed(ctx: &egui::Context, actions: &[Info], scope: Scope) -> Vec<usize> {
    let before: Focus = ctx
        .data(|data| data.get_temp(Focus::id()))
        .unwrap_or_default();
    let now = Focus::of(ctx);
    let asked = !ctx.memory(|memory| memory.allows_interaction(egui::LayerId::background()));
    let focused = now.widget || before.widget || asked || egui::Popup::is_any_open(ctx);
    // A field has no use for such keys; a question that stands before the window may.
    let while_typing = |info: &Info| info.while_typing && !asked;
    let typing = now.text || before.text;
    let mut order: Vec<usize> = (0..actions.len()).collect();
    order.sort_by_key(|&place| !actions[place].modifiers.shift);
    ctx.input_mut(|input| {
        order
            .into_iter()
            .filter(|&place| {
                let info = &actions[place];
                info.scope == scope
                    && (!focused || info.modifiers != Modifiers::NONE || while_typing(info))
                    && (!typing || info.while_typing)
                    && info.keys.iter().any(|&key| {
                        if info.is_held {
                            input.modifiers.is_none() && input.key_down(key)
                        } else {
                            input.consume_key(info.modifiers, key)
                        }
                    })
            })
            .collect()
    })
}
