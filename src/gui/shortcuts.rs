//! The one table of shortcuts: it says what keys do, and the help window shows it.

use egui::{Key, Modifiers};

/// Where a shortcut counts: panes only while the pointer is over them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    Window,
    Picture,
    View3d,
    Tree,
    Leaves,
    Cost,
    Trade,
    Time,
    Sweep,
}

impl Scope {
    pub const ALL: [Scope; 9] = [
        Scope::Window,
        Scope::Picture,
        Scope::View3d,
        Scope::Tree,
        Scope::Leaves,
        Scope::Cost,
        Scope::Trade,
        Scope::Time,
        Scope::Sweep,
    ];

    pub const fn title(self) -> &'static str {
        match self {
            Scope::Window => "Everywhere",
            Scope::Picture => "Pointer over the picture",
            Scope::View3d => "Pointer over the 3D view",
            Scope::Tree => "Pointer over the outline of the tree",
            Scope::Leaves => "Pointer over the leaf histograms",
            Scope::Cost => "Pointer over the split cost",
            Scope::Trade => "Pointer over the trade",
            Scope::Time => "Pointer over the time by term",
            Scope::Sweep => "Pointer over the sweep",
        }
    }
}

/// What a shortcut does.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    Help,
    Palette,
    Open,
    SaveWorkspace,
    SaveWorkspaceAs,
    CopyCommand,
    ExportPicture,
    ExportHeatmap,
    ExportView3d,
    ExportFigures,
    ExportLeaves,
    ExportPage,
    Path,
    Reload,
    Cancel,
    Again,
    NextMethod,
    Deeper,
    Shallower,
    AutoDepth,
    MoreInLeaf,
    FewerInLeaf,
    MoreRecursion,
    LessRecursion,
    ResetMethod,
    SceneCamera,
    Undo,
    Redo,
    Compare,
    OtherTree,
    Paper,
    Lessons,
    LessonReveal,
    LessonNext,
    LessonBack,
    Theme,
    LeftBar,
    RightBar,
    ResetLayout,
    FirstStep,
    PreviousStep,
    NextStep,
    LastStep,
    Play,
    LeavesOnly,
    ShowBuild,
    BuildFirst,
    BuildPrevious,
    BuildNext,
    BuildLast,
    PlayBuild,
    BuildByNode,
    PreviousRay,
    NextRay,
    Fit,
    ActualSize,
    PickLeft,
    PickRight,
    PickUp,
    PickDown,
    Unpick,
    Pin,
    NextView,
    Flip,
    WipeLeft,
    WipeRight,
    OutlineSelection,
    NextHeatmap,
    PreviousHeatmap,
    LogScale,
    LockRange,
    LessExpensive,
    MoreExpensive,
    FrameSelection,
    FrameAll,
    Front,
    Side,
    Top,
    Orthographic,
    Link,
    ShowScene,
    ShowBoxes,
    ShowRays,
    NextColoring,
    ShowFull,
    ShowEmpty,
    Shown,
    AllDepths,
    VisitedOrNot,
    Cut,
    CutAxis,
    CutSide,
    CutLess,
    CutMore,
    FlyForward,
    FlyBack,
    FlyLeft,
    FlyRight,
    FlyUp,
    FlyDown,
    RowUp,
    RowDown,
    Fold,
    Unfold,
    FrameNode,
    FindNext,
    FindPrevious,
    MoreVisited,
    LessVisited,
    ClearRanges,
    UndoWhatIf,
    RunTrade,
    NextOutcome,
    PreviousOutcome,
    NextError,
    ErrorMap,
    MeasureTimes,
    NextExtent,
    NextTimes,
    ClearRegion,
    RunSweep,
    NextParameter,
    PreviousParameter,
    SweepMap,
    FoldLegend,
    /// Done with the mouse; listed for the help window alone.
    Mouse,
}

/// One line of the table.
pub struct Shortcut {
    pub action: Action,
    pub scope: Scope,
    pub modifiers: Modifiers,
    /// Any of these; none for what is done with the mouse.
    pub keys: &'static [Key],
    /// As people write it.
    pub text: &'static str,
    pub about: &'static str,
}

macro_rules! shortcuts {
    ($( $scope:ident $action:ident $modifiers:ident $(+ $more:ident)? [$($key:ident)*] $text:literal $about:literal; )*) => {
        /// Every shortcut.
        pub static SHORTCUTS: &[Shortcut] = &[$( Shortcut {
            action: Action::$action,
            scope: Scope::$scope,
            modifiers: Modifiers::$modifiers$(.plus(Modifiers::$more))?,
            keys: &[$(Key::$key),*],
            text: $text,
            about: $about,
        } ),*];
    };
}

shortcuts! {
    Window Help NONE [Questionmark F1] "? or F1" "Show or hide the list of shortcuts";
    Window Palette COMMAND [K P] "Ctrl+K or Ctrl+P" "Search for a command and do it";
    Window Open COMMAND [O] "Ctrl+O" "Open a scene or a workspace";
    Window SaveWorkspaceAs COMMAND+SHIFT [S] "Ctrl+Shift+S" "Save the workspace under another name";
    Window SaveWorkspace COMMAND [S] "Ctrl+S" "Save the workspace: scene, settings, camera, panes, selection, notes";
    Window CopyCommand COMMAND+SHIFT [C] "Ctrl+Shift+C" "Copy settings and camera as a command";
    Window ExportPicture ALT [Num1] "Alt+1" "Export the picture: PNG or EXR";
    Window ExportHeatmap ALT [Num2] "Alt+2" "Export the heatmap: PNG with its legend, or EXR";
    Window ExportView3d ALT [Num3] "Alt+3" "Export the 3D view: PNG";
    Window ExportFigures ALT [Num4] "Alt+4" "Export the figures: text, JSON, CSV, Markdown, LaTeX";
    Window ExportLeaves ALT [Num5] "Alt+5" "Export the leaf boxes shown: OBJ or PLY";
    Window ExportPage ALT [Num6] "Alt+6" "Export a report: one HTML file";
    Window Path COMMAND [L] "Ctrl+L" "Type a path or a generator's name";
    Window Reload NONE [F5] "F5" "Read the scene's file again";
    Window Cancel NONE [Escape] "Esc" "Close a message, or cancel what is being worked on";
    Window Again COMMAND [R] "Ctrl+R" "Start again what was cancelled";
    Window NextMethod COMMAND [M] "Ctrl+M" "Next build method";
    Window Deeper COMMAND [ArrowUp] "Ctrl+Up" "D_MAX one level deeper";
    Window Shallower COMMAND [ArrowDown] "Ctrl+Down" "D_MAX one level less";
    Window AutoDepth COMMAND [A] "Ctrl+A" "D_MAX automatic or not";
    Window MoreInLeaf COMMAND [ArrowRight] "Ctrl+Right" "N_OILF one object more";
    Window FewerInLeaf COMMAND [ArrowLeft] "Ctrl+Left" "N_OILF one object less";
    Window MoreRecursion COMMAND [PageUp] "Ctrl+Page up" "D_AREC one level more";
    Window LessRecursion COMMAND [PageDown] "Ctrl+Page down" "D_AREC one level less";
    Window ResetMethod COMMAND [Backspace] "Ctrl+Backspace" "Settings of the method back to the paper's";
    Window SceneCamera COMMAND [Home] "Ctrl+Home" "Back to the scene's own camera";
    Window Undo COMMAND [Z] "Ctrl+Z" "Undo the last change of settings, scene or camera";
    Window Redo COMMAND [Y] "Ctrl+Y" "Redo what was undone";
    Window Compare COMMAND [E] "Ctrl+E" "Compare with another tree, B, or end that";
    Window OtherTree NONE [J] "J" "Bring the other of two compared trees to the front";
    Window Paper COMMAND [U] "Ctrl+U" "Repeat the paper's experiment, or cancel that";
    Window Lessons COMMAND [J] "Ctrl+J" "List the lessons, or leave the one that is taken";
    Window LessonReveal ALT [Enter] "Alt+Enter" "Lesson: show the figures after your prediction";
    Window LessonNext ALT [PageDown] "Alt+Page down" "Lesson: the next step";
    Window LessonBack ALT [PageUp] "Alt+Page up" "Lesson: the step before";
    Window Theme COMMAND [T] "Ctrl+T" "Light or dark window";
    Window LeftBar COMMAND [B] "Ctrl+B" "Show or hide the bar on the left";
    Window RightBar COMMAND [I] "Ctrl+I" "Show or hide the bar on the right";
    Window ResetLayout COMMAND [D] "Ctrl+D" "Panes, bars and panels back to where they were at first";
    Window PreviousRay NONE [PageUp] "Page up" "Previous ray of the picked pixel";
    Window NextRay NONE [PageDown] "Page down" "Next ray of the picked pixel";
    Window FirstStep SHIFT [Home] "Shift+Home" "First step of the ray's walk";
    Window PreviousStep NONE [Comma] "," "One step of the walk back";
    Window NextStep NONE [Period] "." "One step of the walk on";
    Window LastStep SHIFT [End] "Shift+End" "Last step of the walk";
    Window Play NONE [Space] "Space" "Play the walk, or pause it";
    Window LeavesOnly NONE [K] "K" "Step through leaves only, or through inner nodes, too";
    Window ShowBuild COMMAND [G] "Ctrl+G" "Show the build of the tree step by step, or the finished tree";
    Window BuildFirst ALT [Home] "Alt+Home" "First moment of the build";
    Window BuildPrevious ALT [ArrowLeft] "Alt+Left" "One step of the build back";
    Window BuildNext ALT [ArrowRight] "Alt+Right" "One step of the build on";
    Window BuildLast ALT [End] "Alt+End" "Last moment of the build: the finished tree";
    Window PlayBuild ALT [P] "Alt+P" "Play the build, or pause it";
    Window BuildByNode ALT [N] "Alt+N" "Go through the build by nodes or by depths";
    Window Mouse NONE [] "Drop a file" "Open it, a scene or a workspace";
    Picture Mouse NONE [] "Click" "Name the object in a pixel and follow its ray";
    Picture Mouse NONE [] "Wheel" "Zoom to the pointer";
    Picture Mouse NONE [] "Right-drag" "Move the picture";
    Picture PickLeft NONE [ArrowLeft] "Left" "Pick the pixel to the left";
    Picture PickRight NONE [ArrowRight] "Right" "Pick the pixel to the right";
    Picture PickUp NONE [ArrowUp] "Up" "Pick the pixel above";
    Picture PickDown NONE [ArrowDown] "Down" "Pick the pixel below";
    Picture Mouse NONE [] "Shift+drag" "Mark a region, whose time by term the pane Time shows";
    Picture ClearRegion SHIFT [Delete] "Shift+Delete" "Mark no region";
    Picture Unpick NONE [Delete] "Delete" "Pick no pixel";
    Picture Pin NONE [P] "P" "Pin the picked pixel to come back to it, or unpin it";
    Picture OutlineSelection NONE [S] "S" "Outline the selected cell and object in the picture, or not";
    Picture PreviousHeatmap SHIFT [H] "Shift+H" "Show the heatmap before";
    Picture NextHeatmap NONE [H] "H" "Show the next heatmap";
    Picture LogScale NONE [G] "G" "Heatmap's colours by the logarithm, or not";
    Picture LockRange NONE [R] "R" "Lock the range of the heatmap's colours, or not";
    Picture MoreExpensive SHIFT [N] "Shift+N" "Pick the pixel before in the order of expense";
    Picture LessExpensive NONE [N] "N" "Pick the most expensive pixel, then the next";
    Picture NextView NONE [W] "W" "Next view of A and B: one, wipe, side by side, difference";
    Picture Flip NONE [F] "F, held" "See the other of A and B while the key is held";
    Picture WipeLeft NONE [OpenBracket] "[" "Move the line between A and B to the left";
    Picture WipeRight NONE [CloseBracket] "]" "Move the line between A and B to the right";
    Picture Mouse NONE [] "Drag" "Move the line between A and B";
    Picture ActualSize COMMAND [Num0] "Ctrl+0" "Actual size: one pixel on one pixel";
    Picture Fit NONE [Home] "Home" "Fit the picture into its pane";
    View3d Mouse NONE [] "Left-drag" "Orbit";
    View3d Mouse NONE [] "Right-drag" "Pan";
    View3d Mouse NONE [] "Wheel" "Zoom to the pointer";
    View3d Mouse NONE [] "Click" "Select the nearest leaf shown; again: the next behind it";
    View3d FrameSelection NONE [F] "F" "Frame the selection";
    View3d FrameAll NONE [Home] "Home" "Frame everything";
    View3d Front NONE [Num1] "1" "Look along the y axis";
    View3d Side NONE [Num3] "3" "Look along the x axis";
    View3d Top NONE [Num7] "7" "Look along the z axis";
    View3d Orthographic NONE [Num5] "5" "Orthographic or perspective";
    View3d Link NONE [L] "L" "Link the picture's camera to this view, or not";
    View3d ShowScene NONE [M] "M" "Show the scene's objects, or not";
    View3d ShowBoxes NONE [B] "B" "Show leaf boxes, or not";
    View3d ShowRays NONE [R] "R" "Show all rays of the picked pixel, or only the selected one";
    View3d NextColoring NONE [C] "C" "Colour leaves by something else";
    View3d ShowFull NONE [O] "O" "Show full leaves, or not";
    View3d ShowEmpty NONE [P] "P" "Show empty leaves, or not";
    View3d Shown NONE [V] "V" "Show only the leaves that the picked ray visited, or all";
    View3d AllDepths NONE [X] "X" "Show all depths";
    View3d VisitedOrNot NONE [N] "N" "Show leaves that the picture's rays visited, those never visited, or all";
    View3d Cut NONE [T] "T" "Cut the view open, or not";
    View3d CutAxis NONE [Y] "Y" "Cut across the next axis";
    View3d CutSide NONE [U] "U" "Hide the other side of the cut";
    View3d CutLess NONE [OpenBracket] "[" "Move the cut down its axis";
    View3d CutMore NONE [CloseBracket] "]" "Move the cut up its axis";
    View3d FoldLegend NONE [I] "I" "Fold the legend to its colours, or unfold it";
    View3d FlyForward NONE [W] "W" "Fly forward";
    View3d FlyBack NONE [S] "S" "Fly back";
    View3d FlyLeft NONE [A] "A" "Fly to the left";
    View3d FlyRight NONE [D] "D" "Fly to the right";
    View3d FlyDown NONE [Q] "Q" "Fly down";
    View3d FlyUp NONE [E] "E" "Fly up";
    Tree RowUp NONE [ArrowUp] "Up" "Select the row above";
    Tree RowDown NONE [ArrowDown] "Down" "Select the row below";
    Tree Unfold NONE [ArrowRight] "Right" "Unfold the node, or go to its first child";
    Tree Fold NONE [ArrowLeft] "Left" "Fold the node, or go to its parent";
    Tree FrameNode NONE [Enter] "Enter" "Show the selected node's cell in 3D";
    Tree FindNext NONE [N] "N" "Select the next match";
    Tree FindPrevious SHIFT [N] "Shift+N" "Select the match before";
    Tree MoreVisited SHIFT [V] "Shift+V" "Select the leaf before in the order of visits";
    Tree LessVisited NONE [V] "V" "Select the most visited leaf, then the next";
    Leaves Mouse NONE [] "Drag" "Select the leaves of these bars; click: of one bar, again: of all";
    Leaves ClearRanges NONE [Delete] "Delete" "Select all leaves again";
    Cost Mouse NONE [] "Drag" "Try a plane; it changes no tree";
    Cost UndoWhatIf NONE [Delete] "Delete or Esc" "Take the tried plane away";
    Trade RunTrade NONE [Enter] "Enter" "Take the trade of time for accuracy; Esc ends it";
    Trade PreviousOutcome NONE [ArrowUp] "Up" "Load the settings of the outcome before";
    Trade NextOutcome NONE [ArrowDown] "Down" "Load the settings of the next outcome";
    Trade NextError NONE [E] "E" "Another measure of the error";
    Trade ErrorMap NONE [M] "M" "Beside the plot the table of outcomes, or the chosen one's error of every pixel";
    Time MeasureTimes NONE [Enter] "Enter" "Measure what nodes and tests take; Esc ends it";
    Time NextExtent NONE [W] "W" "Time of the whole picture, the marked region or the picked pixel";
    Time NextTimes NONE [C] "C" "Times of the terms by regression or in place";
    Sweep RunSweep NONE [Enter] "Enter" "Take the sweep over depths and leaf sizes; Esc ends it";
    Sweep PreviousParameter SHIFT [E] "Shift+E" "Parameter of the sweep before";
    Sweep NextParameter NONE [E] "E" "Next parameter of the sweep";
    Sweep SweepMap NONE [M] "M" "Curves of the sweep, or its map";
}

/// Flying and flipping go on while a key is held; all else happens once.
fn is_held(action: Action) -> bool {
    use Action::{Flip, FlyBack, FlyDown, FlyForward, FlyLeft, FlyRight, FlyUp};
    matches!(
        action,
        Flip | FlyForward | FlyBack | FlyLeft | FlyRight | FlyUp | FlyDown
    )
}

/// Whether keys do it while text is typed: they are none that edit it.
fn goes_while_typing(action: Action) -> bool {
    use Action::{LessonBack, LessonNext, LessonReveal, Lessons, Open, Palette};
    use Action::{SaveWorkspace, SaveWorkspaceAs};
    matches!(
        action,
        Open | Palette
            | Lessons
            | LessonReveal
            | LessonNext
            | LessonBack
            | SaveWorkspace
            | SaveWorkspaceAs
    )
}

/// An action that was chosen by its name, until the scope that it belongs to takes it.
#[derive(Clone, Copy)]
struct Chosen {
    action: Action,
    /// When, in the window's seconds.
    time: f64,
}

impl Chosen {
    /// Where it waits.
    fn id() -> egui::Id {
        egui::Id::unique("chosen action")
    }
}

/// How long a chosen action may wait for its pane, in seconds: longer would come as a surprise.
const PATIENCE: f64 = 2.0;

/// Asks for an action as if its keys were pressed where they count.
pub fn choose(ctx: &egui::Context, action: Action) {
    let time = ctx.input(|i| i.time);
    ctx.data_mut(|data| data.insert_temp(Chosen::id(), Chosen { action, time }));
    ctx.request_repaint();
}

/// The action that was chosen for this scope, once.
fn take_chosen(ctx: &egui::Context, scope: Scope) -> Option<Action> {
    let chosen: Chosen = ctx.data(|data| data.get_temp(Chosen::id()))?;
    if self::scope(chosen.action) != Some(scope) {
        return None;
    }
    ctx.data_mut(|data| data.remove::<Chosen>(Chosen::id()));
    let waited = ctx.input(|i| i.time) - chosen.time;
    (waited < PATIENCE).then_some(chosen.action)
}

/// Where an action belongs.
pub fn scope(action: Action) -> Option<Scope> {
    let line = SHORTCUTS.iter().find(|s| s.action == action)?;
    Some(line.scope)
}

/// What this frame asks a scope to do: by its keys if `here`, that is where they count, and by
/// [`choose`] wherever the pointer is.
pub fn pressed(ctx: &egui::Context, scope: Scope, here: bool) -> Vec<Action> {
    let mut actions = if here { keys(ctx, scope) } else { Vec::new() };
    actions.extend(take_chosen(ctx, scope));
    actions
}

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

/// Notes where keys go as a frame begins. In a slow frame a text and the Enter that ends it come
/// together: panes, which ask later, are not to take its letters for shortcuts.
pub fn note_focus(ctx: &egui::Context) {
    let focus = Focus::of(ctx);
    ctx.data_mut(|data| data.insert_temp(Focus::id(), focus));
}

/// What the keys of this frame ask for. A shortcut without Shift takes a key with Shift too, so the
/// one with Shift comes before it in the table. Plain keys belong to the focused widget, the open list, or
/// the question that stands before the window, if there is one.
fn keys(ctx: &egui::Context, scope: Scope) -> Vec<Action> {
    let before: Focus = ctx
        .data(|data| data.get_temp(Focus::id()))
        .unwrap_or_default();
    let now = Focus::of(ctx);
    let asked = !ctx.memory(|memory| memory.allows_interaction(egui::LayerId::background()));
    let focused = now.widget || before.widget || asked || egui::Popup::is_any_open(ctx);
    let typing = now.text || before.text;
    ctx.input_mut(|input| {
        SHORTCUTS
            .iter()
            .filter(|s| s.scope == scope)
            .filter(|s| !focused || s.modifiers != Modifiers::NONE)
            .filter(|s| !typing || goes_while_typing(s.action))
            .filter(|s| {
                s.keys.iter().any(|&key| {
                    if is_held(s.action) {
                        input.modifiers.is_none() && input.key_down(key)
                    } else {
                        input.consume_key(s.modifiers, key)
                    }
                })
            })
            .map(|s| s.action)
            .collect()
    })
}

/// The keys of an action, for tooltips; empty if it has none.
pub fn text(action: Action) -> &'static str {
    SHORTCUTS
        .iter()
        .find(|s| s.action == action)
        .map_or("", |s| s.text)
}

/// A tooltip: what a widget does, and its shortcut.
pub fn tip(about: &str, action: Action) -> String {
    format!("{about}\nShortcut: {}", text(action))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_key_does_two_things_in_one_place() {
        assert!(!SHORTCUTS.is_empty());
        for (i, a) in SHORTCUTS.iter().enumerate() {
            for b in &SHORTCUTS[..i] {
                let meet =
                    a.scope == b.scope || a.scope == Scope::Window || b.scope == Scope::Window;
                let same = a.modifiers == b.modifiers && a.keys.iter().any(|k| b.keys.contains(k));
                assert!(!(meet && same), "{} is there twice", a.text);
            }
        }
    }
}
