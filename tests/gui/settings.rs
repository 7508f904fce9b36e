//! Every setting has a widget.

use crate::harness::{finish, has, open, small};
use bspscope::setup::Setup;
use bspscope::structure::{BuildSettings, Method};

#[test]
fn every_setting_has_a_widget() {
    for method in Method::all() {
        let mut start = small("tetra:1");
        start.setup.build = BuildSettings::for_method(method);
        let mut window = open(start);
        finish(&mut window);
        let setup = Setup::of_method(method);
        for setting in setup.settings() {
            // These stand in the bar at the top.
            let name = match setting.name {
                "method" => "Build method",
                "d-max" | "n-oilf" | "d-arec" => setting.symbol.unwrap(),
                "resolution" => "Width",
                _ => setting.label,
            };
            assert!(has(&window, name), "{}: no widget {name}", setting.name);
        }
    }
}
