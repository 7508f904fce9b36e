//! The icons: characters of the font `assets/fonts/Phosphor.ttf`, which every font family of the
//! window contains, so that an icon can stand in any text.
//!
//! To add an icon, add a line with its name at phosphoricons.com and run `assets/fonts/subset.py`.

// Playback and steps.
pub const PLAY: &str = "\u{e3d0}"; // play
pub const PAUSE: &str = "\u{e39e}"; // pause
pub const STOP: &str = "\u{e46c}"; // stop
pub const FIRST: &str = "\u{e5a4}"; // skip-back
pub const PREVIOUS: &str = "\u{e138}"; // caret-left
pub const NEXT: &str = "\u{e13a}"; // caret-right
pub const LAST: &str = "\u{e5a6}"; // skip-forward

// Files and editing.
pub const FOLDER: &str = "\u{e256}"; // folder-open
pub const SAVE: &str = "\u{e248}"; // floppy-disk
pub const COPY: &str = "\u{e1ca}"; // copy
pub const EXPORT: &str = "\u{eaf0}"; // export
pub const UNDO: &str = "\u{e038}"; // arrow-counter-clockwise
pub const REDO: &str = "\u{e036}"; // arrow-clockwise
pub const CAMERA: &str = "\u{e10e}"; // camera

// The window.
pub const SEARCH: &str = "\u{e30c}"; // magnifying-glass
pub const GEAR: &str = "\u{e272}"; // gear-six
pub const DOTS: &str = "\u{e1fe}"; // dots-three
pub const LIST: &str = "\u{e2f0}"; // list
pub const SLIDERS: &str = "\u{e434}"; // sliders-horizontal
pub const MAXIMIZE: &str = "\u{e1d0}"; // corners-out
pub const MINIMIZE: &str = "\u{e1ce}"; // corners-in
pub const CLOSE: &str = "\u{e4f6}"; // x
pub const PLUS: &str = "\u{e3d4}"; // plus
pub const MINUS: &str = "\u{e32a}"; // minus
pub const PIN: &str = "\u{e3e2}"; // push-pin
pub const LINK: &str = "\u{e2e2}"; // link
pub const UNLINK: &str = "\u{e2e4}"; // link-break
pub const EYE: &str = "\u{e220}"; // eye
pub const EYE_SLASH: &str = "\u{e224}"; // eye-slash
pub const SUN: &str = "\u{e472}"; // sun
pub const MOON: &str = "\u{e330}"; // moon

// Tasks and panes.
pub const GRADUATION_CAP: &str = "\u{e62c}"; // graduation-cap
pub const PRESENTATION: &str = "\u{e654}"; // presentation
pub const SCALES: &str = "\u{e750}"; // scales
pub const IMAGE: &str = "\u{e2ca}"; // image
pub const CUBE: &str = "\u{e1da}"; // cube
pub const FRAME: &str = "\u{e626}"; // frame-corners
pub const TREE: &str = "\u{e67c}"; // tree-structure
pub const CHART_LINE: &str = "\u{e154}"; // chart-line
pub const CHART_BAR: &str = "\u{e150}"; // chart-bar
pub const PATH: &str = "\u{e39c}"; // path
pub const TARGET: &str = "\u{e1d6}"; // crosshair

// Messages and marks.
pub const QUESTION: &str = "\u{e3e8}"; // question
pub const INFO: &str = "\u{e2ce}"; // info
pub const WARNING: &str = "\u{e4e0}"; // warning
pub const ERROR: &str = "\u{e4e2}"; // warning-circle
pub const CHECK: &str = "\u{e182}"; // check
pub const SPINNER: &str = "\u{eb44}"; // circle-notch
pub const TIMER: &str = "\u{e492}"; // timer
pub const FLAG: &str = "\u{e244}"; // flag
pub const STAR: &str = "\u{e46a}"; // star
pub const LIGHTNING: &str = "\u{e2de}"; // lightning

// Directions.
pub const CARET_DOWN: &str = "\u{e136}"; // caret-down
pub const CARET_UP: &str = "\u{e13c}"; // caret-up
pub const CARET_LEFT: &str = "\u{e138}"; // caret-left
pub const CARET_RIGHT: &str = "\u{e13a}"; // caret-right
pub const ARROW_UP: &str = "\u{e08e}"; // arrow-up
pub const ARROW_DOWN: &str = "\u{e03e}"; // arrow-down
pub const ARROW_LEFT: &str = "\u{e058}"; // arrow-left
pub const ARROW_RIGHT: &str = "\u{e06c}"; // arrow-right
