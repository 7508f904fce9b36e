//! The actions of the window itself.

use super::app::App;
use super::top_bar;
use crate::gui::action::{Action, actions};
use crate::scene::CameraOverride;
use crate::structure::BuildSettings;

/// The most that the window lets secondary rays recurse.
const MOST_RECURSION: u32 = 50;

/// The most objects of a leaf that keys go to.
const MOST_OBJECTS: u32 = 10_000;

type AppAction = Action<fn(&mut App, &egui::Context)>;

/// What the window's own keys and menus do.
pub const ACTIONS: &[AppAction] = actions! {
    "window.help" Everywhere NONE [Questionmark, F1] "Show or hide the list of shortcuts" => |app, _| app.help_open ^= true;
    "window.palette" Everywhere COMMAND [K, P] "Search for a command and run it" typing => |app, _| app.toggle_palette();
    "window.explore" Everywhere COMMAND [Num1] "Explore: picture, tree and figures" => |app, _| app.switch("explore");
    "window.ray" Everywhere COMMAND [Num2] "Ray: follow one pixel's rays" => |app, _| app.switch("ray");
    "window.compare" Everywhere COMMAND [Num3] "Compare: two trees side by side" => |app, _| app.switch("compare");
    "window.tune" Everywhere COMMAND [Num4] "Tune: find the best tree" => |app, _| app.switch("tune");
    "window.lessons" Everywhere COMMAND [Num5] "Lessons: guided tours" => |app, _| app.switch("lessons");
    "window.toggle-compare" Everywhere COMMAND [E] "Compare with a second tree, B, or end the comparison" => |app, _| {
        let to = if app.doc.other.is_some() { "explore" } else { "compare" };
        app.switch(to);
    };
    "window.present" Everywhere NONE [F11] "Present: full screen, larger type" typing => |app, ctx| app.toggle_present(ctx);
    "window.open" Everywhere COMMAND [O] "Open a scene or a workspace" typing => |app, ctx| app.files.open_dialog(ctx);
    "window.save-workspace-as" Everywhere COMMAND+SHIFT [S] "Save the workspace under another name" typing => |app, _| app.save_workspace_as();
    "window.save-workspace" Everywhere COMMAND [S] "Save the workspace: scene, settings, camera, panes, selection, notes" typing => |app, ctx| app.save_workspace(ctx);
    "window.copy-command" Everywhere COMMAND+SHIFT [C] "Copy settings and camera as a command" => |app, ctx| app.copy_command(ctx);
    "window.path" Everywhere COMMAND [L] "Type a path or a generator's name" => |app, _| app.files.focus_path();
    "window.reload" Everywhere NONE [F5] "Read the scene's file again" => |app, _| app.doc.reload();
    "window.cancel" Everywhere NONE [Escape] "Close a message, leave a task, or stop the work in progress" => |app, ctx| app.escape(ctx);
    "window.again" Everywhere COMMAND [R] "Resume what was stopped" => |app, _| app.doc.again();
    "window.next-method" Everywhere COMMAND [M] "Select the next build method" => |app, _| app.doc.next_method();
    "window.deeper" Everywhere COMMAND [ArrowUp] "Depth: one level more" => |app, _| app.doc.deepen(1);
    "window.shallower" Everywhere COMMAND [ArrowDown] "Depth: one level less" => |app, _| app.doc.deepen(-1);
    "window.auto-depth" Everywhere COMMAND [A] "Depth: automatic or not" => |app, _| app.doc.toggle_automatic_depth();
    "window.more-in-leaf" Everywhere COMMAND [ArrowRight] "Leaf size: one object more" => |app, _| shift(&mut app.doc.wanted.build.n_oilf, 1, MOST_OBJECTS);
    "window.fewer-in-leaf" Everywhere COMMAND [ArrowLeft] "Leaf size: one object less" => |app, _| shift(&mut app.doc.wanted.build.n_oilf, -1, MOST_OBJECTS);
    "window.more-recursion" Everywhere COMMAND [PageUp] "Bounces: one level more" => |app, _| shift(&mut app.doc.wanted.render.d_arec, 1, MOST_RECURSION);
    "window.less-recursion" Everywhere COMMAND [PageDown] "Bounces: one level less" => |app, _| shift(&mut app.doc.wanted.render.d_arec, -1, MOST_RECURSION);
    "window.reset-method" Everywhere COMMAND [Backspace] "Reset the method's settings to the paper's" => |app, _| {
        let build = &mut app.doc.wanted.build;
        *build = BuildSettings::for_method(build.method);
    };
    "window.scene-camera" Everywhere COMMAND [Home] "Return to the scene's own camera" => |app, _| app.doc.wanted.render.camera = CameraOverride::default();
    "window.undo" Everywhere COMMAND [Z] "Undo the last change of settings, scene or camera" => |app, _| { app.doc.undo(); app.follow_comparison(); };
    "window.redo" Everywhere COMMAND [Y] "Redo what was undone" => |app, _| { app.doc.redo(); app.follow_comparison(); };
    "window.other-tree" Everywhere NONE [J] "Bring the other of two compared trees to the front" => |app, _| app.doc.show(app.doc.which.other());
    "window.maximize" Everywhere NONE [Z] "Maximize the pane under the pointer, or restore it" => |app, _| app.maximize_under_pointer();
    "window.settings" Everywhere COMMAND [I] "Show or hide the settings" => |app, _| app.layout.settings ^= true;
    "window.strip" Everywhere COMMAND [B] "Close the pane at the bottom, or open the last one" => |app, _| app.toggle_bottom();
    "window.theme" Everywhere COMMAND [T] "Light or dark window" => |_, ctx| top_bar::toggle_theme(ctx);
    "window.reset-layout" Everywhere COMMAND [D] "Reset the panes of this task" => |app, _| app.layout.reset();
};

fn shift(value: &mut u32, by: i32, most: u32) {
    *value = value.saturating_add_signed(by).min(most);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::action::{Info, Scope};
    use crate::gui::panes::PANES;

    #[test]
    fn no_key_does_two_things_in_one_place() {
        let shell = ACTIONS.iter().map(|action| ("window", action.info));
        let panes = PANES.iter().flat_map(|entry| {
            let actions = entry.actions().into_iter();
            actions.map(|info| (entry.id, info))
        });
        let all: Vec<(&str, Info)> = shell.chain(panes).collect();
        assert!(all.len() > 100);
        for (i, (owner, a)) in all.iter().enumerate() {
            assert!(a.id.starts_with(&format!("{owner}.")), "{}", a.id);
            for (other, b) in &all[..i] {
                assert_ne!(a.id, b.id);
                let everywhere = a.scope == Scope::Everywhere || b.scope == Scope::Everywhere;
                // While a lesson runs, its keys are its own.
                let lesson = [a, b].map(|info| info.scope == Scope::Lesson);
                let apart = lesson[0] != lesson[1];
                let same = a.modifiers == b.modifiers && a.keys.iter().any(|k| b.keys.contains(k));
                assert!(
                    apart || !(same && (everywhere || owner == other)),
                    "{} and {}",
                    a.id,
                    b.id
                );
            }
        }
    }
}
