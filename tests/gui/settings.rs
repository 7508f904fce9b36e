//! Every setting has a widget in the drawer.

use crate::harness::{Window, click, finish, open, open_sized, press, small, wait};
use crate::painted::assert_whole;
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, MaxDepth, Method};
use egui::Rect;
use egui::accesskit::Role;
use egui_kittest::kittest::Queryable as _;

fn open_drawer(window: &mut Window<'_>) {
    press(window, egui::Modifiers::COMMAND, egui::Key::I);
}

/// The name of a setting in the drawer.
fn name(label: &str) -> String {
    let words = label.replace('-', " ");
    words[..1].to_uppercase() + &words[1..]
}

#[test]
fn every_setting_has_a_widget() {
    for method in Method::all() {
        let mut start = small("tetra:1");
        start.setup.build = BuildSettings::for_method(method);
        let mut window = open(start);
        open_drawer(&mut window);
        let setup = Setup::of_method(method);
        for setting in setup.settings() {
            let name = name(setting.label);
            // Its label, and a widget with the same name.
            let named = window.query_all_by_label(&name).count();
            assert!(
                named >= 2 || name == "Resolution",
                "{}: {named} × {name}",
                setting.name
            );
            if let Some(symbol) = setting.symbol {
                window.get_by_label(symbol);
            }
        }
    }
}

#[test]
fn the_minimum_contribution_is_set_in_the_drawer() {
    let mut window = open(small("tetra:1"));
    open_drawer(&mut window);
    assert_eq!(window.state().setup().render.min_contribution, 0.0);
    let field = window.get_by_role_and_label(Role::SpinButton, "Minimum contribution");
    field.set_value_accesskit(0.25);
    window.run_steps(3);
    assert_eq!(window.state().setup().render.min_contribution, 0.25);
}

#[test]
fn nothing_in_the_drawer_is_cut() {
    for size in [[1600.0, 1000.0], [1280.0, 720.0]] {
        let mut start = small("tetra:1");
        start.setup.build = BuildSettings::for_method(Method::named("sah-cut").unwrap());
        let mut window = open_sized(start, size, false);
        open_drawer(&mut window);
        finish(&mut window);
        assert_whole(&window, Rect::everything_right_of(size[0] - 280.0));
    }
}

#[test]
fn method_and_depth_in_the_top_bar_are_settings_like_those_of_the_drawer() {
    let mut window = open_sized(small("tetra:1"), [1280.0, 720.0], false);
    finish(&mut window);
    window
        .get_by_role_and_label(Role::ComboBox, "Method")
        .click();
    window.run_steps(3);
    // All methods are in view, each by its one name.
    for method in Method::all() {
        let item = window.get_by_role_and_label(Role::Button, method.name);
        assert!(item.rect().bottom() < 720.0, "{}", method.name);
    }
    click(&mut window, "octree");
    wait(&mut window, "the method", |w| {
        w.state().setup().build.method.name == "octree"
    });
    let resolved = MaxDepth::Automatic.resolve(4);
    click(&mut window, "Auto");
    assert_eq!(window.state().setup().build.d_max, MaxDepth::Automatic);
    finish(&mut window);
    click(&mut window, "Auto");
    assert_eq!(
        window.state().setup().build.d_max,
        MaxDepth::Fixed(resolved)
    );
}
