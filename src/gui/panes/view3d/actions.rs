//! What the keys of the 3D view do.

use super::settings::Cells;
use super::view::View3d;
use super::{export, framing};
use crate::geometry::{Axis, Vec3};
use crate::gui::action::actions;
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, PaneAction};
use crate::present::overlay::Filter;

/// The actions of the view.
pub const ACTIONS: &[PaneAction<View3d>] = actions! {
    "view3d.export" Everywhere ALT [Num3] "Export the 3D view: PNG" => |view, cx| {
        let export = export::screen(view, cx.ctx);
        cx.edits.request(Request::Export(Box::new(export)));
    };
    "view3d.export-leaves" Everywhere ALT [Num5] "Export the leaf boxes shown: OBJ or PLY" => |view, cx| {
        let export = export::leaves(view, cx.doc);
        cx.edits.request(Request::Export(Box::new(export)));
    };
    "view3d.frame-selection" Here NONE [F] "Frame the selection" => |view, cx| {
        if let Some(bounds) = cx.doc.current.as_ref().and_then(framing::selected) {
            view.camera.show(&bounds);
            view.keyed = true;
        }
    };
    "view3d.frame-all" Here NONE [Home] "Frame everything" => |view, cx| {
        if let Some(current) = &cx.doc.current {
            view.camera.show(&current.shown.tree.root_cell());
            view.keyed = true;
        }
    };
    "view3d.front" Here NONE [Num1] "Look along the y axis" => |view, _| look(view, Axis::Y);
    "view3d.side" Here NONE [Num3] "Look along the x axis" => |view, _| look(view, Axis::X);
    "view3d.top" Here NONE [Num7] "Look along the z axis" => |view, _| look(view, Axis::Z);
    "view3d.orthographic" Here NONE [Num5] "Switch between orthographic and perspective" => |view, _| view.camera.orthographic ^= true;
    "view3d.link" Here NONE [L] "Use the same camera as the picture, or not" => |view, cx| view.link(!view.settings.linked, cx.doc);
    "view3d.show-scene" Here NONE [M] "Show the scene's objects, or not" => |view, _| view.settings.scene ^= true;
    "view3d.show-boxes" Here NONE [B] "Show leaf boxes, or not" => |view, _| view.settings.toggle_cells();
    "view3d.show-rays" Here NONE [R] "Show all rays of the picked pixel, or only the selected one" => |view, _| view.settings.all_rays ^= true;
    "view3d.next-coloring" Here NONE [C] "Color leaves by the next property" => |view, _| view.settings.next_coloring();
    "view3d.show-full" Here NONE [O] "Show full leaves, or not" => |view, _| view.settings.filter.full ^= true;
    "view3d.show-empty" Here NONE [P] "Show empty leaves, or not" => |view, _| view.settings.filter.empty ^= true;
    "view3d.shown" Here NONE [V] "Show only the leaves that the selected ray visited, or all" => |view, _| view.settings.toggle(Cells::Visited);
    "view3d.all-depths" Here NONE [X] "Show all leaves at all depths" => |view, _| {
        view.settings.filter.depth = Filter::default().depth;
        view.settings.cells = Cells::All;
    };
    "view3d.visited-or-not" Here NONE [N] "Show leaves that the picture's rays visited, never visited, or all" => |view, _| view.settings.next_visited();
    "view3d.outside" Here NONE [H] "Show, fade or hide what is outside of the selected subtree" => |view, _| view.settings.next_outside();
    "view3d.cut" Here NONE [T] "Cut the view open, or not" => |view, _| view.settings.cut.toggle();
    "view3d.cut-axis" Here NONE [Y] "Cut across the next axis" => |view, _| view.settings.cut.turn();
    "view3d.cut-side" Here NONE [U] "Hide the other side of the cut" => |view, _| view.settings.cut.flip();
    "view3d.cut-less" Here NONE [OpenBracket] "Move the cut down its axis" => |view, _| view.settings.cut.shift(-1.0);
    "view3d.cut-more" Here NONE [CloseBracket] "Move the cut up its axis" => |view, _| view.settings.cut.shift(1.0);
    "view3d.fold-legend" Here NONE [I] "Fold the legend to its colors, or unfold it" => |view, _| view.fold_legend();
    "view3d.fly-forward" Here NONE [W] "Fly forward" held => |view, cx| fly(view, Vec3::X, cx);
    "view3d.fly-back" Here NONE [S] "Fly back" held => |view, cx| fly(view, -Vec3::X, cx);
    "view3d.fly-left" Here NONE [A] "Fly to the left" held => |view, cx| fly(view, -Vec3::Y, cx);
    "view3d.fly-right" Here NONE [D] "Fly to the right" held => |view, cx| fly(view, Vec3::Y, cx);
    "view3d.fly-down" Here NONE [Q] "Fly down" held => |view, cx| fly(view, -Vec3::Z, cx);
    "view3d.fly-up" Here NONE [E] "Fly up" held => |view, cx| fly(view, Vec3::Z, cx);
};

/// Moves the camera forward, to the right and up while a key is held.
fn fly(view: &mut View3d, direction: Vec3, cx: &mut Cx<'_>) {
    /// Orbited distances per second.
    const SPEED: f64 = 0.8;
    let dt = cx.ctx.input(|i| f64::from(i.stable_dt)).min(0.1);
    view.camera.fly(direction * (SPEED * dt));
    view.keyed = true;
}

/// Looks along an axis; a second time from the other side.
fn look(view: &mut View3d, axis: Axis) {
    let direction = [-Vec3::X, Vec3::Y, -Vec3::Z][axis.index()];
    let up = if axis == Axis::Z { Vec3::Y } else { Vec3::Z };
    let [forward, ..] = view.camera.frame();
    let turned = if forward.dot(direction) > 0.999_999 {
        -direction
    } else {
        direction
    };
    view.camera.look(turned, up);
    view.keyed = true;
}
