//! The lesson that is taken: at which step, what was predicted, and what was there before it.

use crate::gui::document::comparing::{View, Which};
use crate::gui::document::{Current, Document, Wanted};
use crate::gui::edits::{Edits, Request};
use crate::gui::pane::{Cx, Entry};
use crate::lesson::{
    Answer, Difference, Figures, Lesson, LessonError, Named, Prediction, Secret, Side, SideFigures,
    Step, Subject, Verdict,
};
use crate::measure::heat::heatmaps;
use crate::setup::Setup;

/// A lesson and how far it is.
pub struct Running {
    pub lesson: Lesson,
    /// Place of the step on view.
    pub at: usize,
    /// What became of every step.
    pub taken: Vec<Taken>,
    /// What is wanted of the step on view.
    wanted: Wanted,
    /// Whether the step's pixel was picked.
    picked: bool,
    /// Whether the step has just come into view: its prediction takes the keys.
    pub is_new: bool,
    before: Before,
}

/// What became of a step.
#[derive(Clone, Default)]
pub struct Taken {
    /// What is typed as a prediction.
    pub typed: String,
    /// The choice that was made, by its place.
    pub chosen: Option<usize>,
    /// What was measured; `None` until it is there.
    pub figures: Option<Figures>,
    /// What became of the prediction; `None` until it is checked.
    pub verdict: Option<Verdict>,
}

/// What there was before the lesson.
pub struct Before {
    wanted: Wanted,
    which: Which,
    view: View,
    heatmap: Option<usize>,
    pixel: Option<[u32; 2]>,
    /// The task that was open.
    task: &'static str,
}

impl Before {
    fn of(doc: &Document) -> Self {
        Before {
            wanted: doc.all_wanted(),
            which: doc.which,
            view: doc.comparing.view,
            heatmap: doc.heatmap,
            pixel: doc.current.as_ref().and_then(Current::picked_pixel),
            task: doc.task,
        }
    }

    /// Ends the lesson: all is as it was.
    pub fn restore(self, edits: &mut Edits) {
        edits.request(Request::Stage(Vec::new()));
        edits.request(Request::Task(self.task));
        edits.add(move |doc| {
            doc.in_lesson = false;
            doc.asked = Secret::default();
            doc.want(self.wanted);
            doc.show(self.which);
            doc.comparing.view = self.view;
            doc.heatmap = self.heatmap;
            if let Some(current) = &mut doc.current {
                match self.pixel {
                    Some(pixel) => current.pick(pixel),
                    None => current.unpick(),
                }
            }
        });
    }
}

impl Running {
    /// Takes the first step; `before` is what there was before another lesson that it follows.
    ///
    /// # Errors
    /// The first name that the window has nothing for, with its line. All is as it was before.
    pub fn begin(
        lesson: Lesson,
        before: Option<Before>,
        cx: &mut Cx<'_>,
    ) -> Result<Running, LessonError> {
        let mut steps = lesson.steps.iter();
        if let Some(error) = steps.find_map(|step| unknown(&lesson, step, cx.panes)) {
            if let Some(before) = before {
                before.restore(cx.edits);
            }
            return Err(error);
        }
        let mut running = Running {
            at: 0,
            taken: vec![Taken::default(); lesson.steps.len()],
            wanted: wanted_of(&lesson.steps[0].subject, cx.doc),
            picked: false,
            is_new: true,
            before: before.unwrap_or_else(|| Before::of(cx.doc)),
            lesson,
        };
        cx.edits.add(|doc| doc.in_lesson = true);
        running.set_up(cx);
        Ok(running)
    }

    pub fn into_before(self) -> Before {
        self.before
    }

    pub fn step(&self) -> &Step {
        &self.lesson.steps[self.at]
    }

    pub fn now(&self) -> &Taken {
        &self.taken[self.at]
    }

    pub fn now_mut(&mut self) -> &mut Taken {
        &mut self.taken[self.at]
    }

    /// Whether a prediction is still to be checked.
    pub fn asks(&self) -> bool {
        self.step().question.is_some() && self.now().verdict.is_none()
    }

    /// What is predicted; `None` where nothing or no number is typed.
    pub fn prediction(&self) -> Option<Prediction> {
        match &self.step().question.as_ref()?.answer {
            Answer::Number { .. } => {
                let typed = self.now().typed.trim().replace(',', ".");
                let number = typed.parse::<f64>().ok().filter(|n| n.is_finite());
                number.map(Prediction::Number)
            }
            Answer::Choice(_) => self.now().chosen.map(Prediction::Choice),
        }
    }

    /// Tells the answer, if there is a prediction and all is measured.
    pub fn check(&mut self, cx: &mut Cx<'_>) {
        let prediction = self.prediction().filter(|_| self.asks());
        if let (Some(prediction), Some(figures), Some(question)) =
            (prediction, &self.now().figures, &self.step().question)
        {
            self.now_mut().verdict = question.answer.judge(prediction, figures);
            self.look(cx);
        }
    }

    /// Whether there is a step after this one that may be gone to.
    pub fn may_go_on(&self) -> bool {
        self.at + 1 < self.lesson.steps.len() && !self.asks()
    }

    pub fn next(&mut self, cx: &mut Cx<'_>) {
        if self.may_go_on() {
            self.at += 1;
            self.set_up(cx);
        }
    }

    pub fn back(&mut self, cx: &mut Cx<'_>) {
        if self.at > 0 {
            self.at -= 1;
            self.set_up(cx);
        }
    }

    /// Whether the user has changed what the step looks at.
    pub fn is_changed(&self, doc: &Document) -> bool {
        doc.all_wanted() != self.wanted
    }

    /// Sets what the step looks at.
    pub fn set_up(&mut self, cx: &mut Cx<'_>) {
        let step = &self.lesson.steps[self.at];
        self.wanted = wanted_of(&step.subject, cx.doc);
        self.picked = false;
        self.is_new = true;
        let (wanted, front) = (self.wanted.clone(), front(&step.subject));
        let view = step.subject.look.view.as_ref();
        let view = view.and_then(|named| view_of(&named.name));
        cx.edits.add(move |doc| {
            doc.want(wanted);
            doc.show(front);
            doc.comparing.view = view.unwrap_or(View::Wipe);
        });
        self.look(cx);
    }

    /// Shows what comes with the answer, or hides what would tell it.
    fn look(&self, cx: &mut Cx<'_>) {
        let look = &self.step().subject.look;
        let asks = self.asks();
        let told = look.heatmap.filter(|_| !asks);
        let heatmap = told.and_then(|symbol| heatmaps().iter().position(|h| h.symbol == symbol));
        let asked = match asks {
            true => self.step().secret(),
            false => Secret::default(),
        };
        cx.edits.add(move |doc| {
            doc.heatmap = heatmap;
            doc.asked = asked;
        });
        cx.edits
            .request(Request::Stage(slots(&self.step().subject, asks, cx.panes)));
    }

    /// Picks the step's pixel once its picture is there, and takes the figures once they are final.
    pub fn follow(&mut self, cx: &mut Cx<'_>) {
        let doc = cx.doc;
        let step = &self.lesson.steps[self.at];
        let subject = &step.subject;
        let is_wanted = |current: &&Current, wanted: &Setup| current.shown.setup == *wanted;
        let in_front = doc.current.as_ref().filter(|c| is_wanted(c, &doc.wanted));
        if let (Some(pixel), false) = (subject.pixel, self.picked)
            && in_front.is_some()
            && !self.is_changed(doc)
        {
            self.picked = true;
            cx.edits.add(move |doc| {
                if let Some(current) = &mut doc.current {
                    current.pick(pixel);
                }
            });
        }
        if self.taken[self.at].figures.is_some() {
            return;
        }
        let [a, b] = doc.both();
        let final_one = |current: Option<&'_ Current>, wanted: &Setup| {
            let current = current.filter(|current| is_wanted(current, wanted))?;
            current.complete.then(|| side_figures(current, subject))
        };
        let of_a = final_one(a, &self.wanted.a);
        let of_b = self.wanted.b.as_ref().map(|wanted| final_one(b, wanted));
        let (Some(of_a), Some(of_b)) = (of_a, of_b.map_or(Some(None), |b| b.map(Some))) else {
            return;
        };
        let difference = match (a, b) {
            (Some(a), Some(b)) if of_b.is_some() => {
                Difference::between(&a.shown.picture, &b.shown.picture)
            }
            _ => None,
        };
        self.taken[self.at].figures = Some(Figures {
            a: of_a,
            b: of_b,
            difference,
        });
    }

    /// How many predictions were right, of how many that were checked.
    pub fn score(&self) -> (usize, usize) {
        let told = self.taken.iter().filter_map(|taken| taken.verdict.as_ref());
        let right = told.clone().filter(|verdict| verdict.is_right()).count();
        (right, told.count())
    }
}

/// The tree that a step is about.
fn front(subject: &Subject) -> Which {
    match subject.look.front {
        Side::A => Which::A,
        Side::B => Which::B,
    }
}

/// What stands beside the lesson: the picture, and the panes that the step names; its panels come with
/// the answer. Where it names nothing, the 3D view, or the picture of B.
fn slots(subject: &Subject, asks: bool, panes: &'static [Entry]) -> Vec<Vec<&'static str>> {
    let look = &subject.look;
    let named = look
        .panes
        .iter()
        .chain(look.panels.iter().filter(|_| !asks));
    let mut third: Vec<&'static str> = Vec::new();
    for pane in named.filter_map(|named| pane_of(panes, &named.name)) {
        if !["picture", "lesson"].contains(&pane.id) && !third.contains(&pane.id) {
            third.push(pane.id);
        }
    }
    let view = look.view.as_ref().and_then(|named| view_of(&named.name));
    if view == Some(View::Beside) && subject.b.is_some() {
        third.insert(0, "picture");
        return vec![third];
    }
    if third.is_empty() {
        third.push("view3d");
    }
    vec![vec!["picture"], third]
}

fn side_figures(current: &Current, subject: &Subject) -> SideFigures {
    let counts = current.pixel_counts.as_ref();
    SideFigures {
        measurement: current.shown.measurement.clone(),
        pixel: subject.pixel.zip(counts).and_then(|([x, y], counts)| {
            let place = y as usize * counts.width as usize + x as usize;
            counts.tallies.get(place).copied()
        }),
    }
}

/// The setups that a step asks for.
fn wanted_of(subject: &Subject, doc: &Document) -> Wanted {
    let on_threads = |setup: &Setup| {
        let mut setup = setup.clone();
        setup.render.threads = doc.wanted.render.threads;
        setup
    };
    Wanted {
        a: on_threads(&subject.a),
        b: subject.b.as_ref().map(on_threads),
    }
}

fn pane_of(panes: &'static [Entry], name: &str) -> Option<&'static Entry> {
    panes.iter().find(|pane| pane.is_called(name))
}

fn view_of(name: &str) -> Option<View> {
    View::ALL.into_iter().find(|view| view.name() == name)
}

/// The first name of a step that the window has nothing for.
fn unknown(lesson: &Lesson, step: &Step, known: &'static [Entry]) -> Option<LessonError> {
    let look = &step.subject.look;
    let unknown = |kind: &str, named: &Named| LessonError {
        file: lesson.name.clone(),
        line: named.line,
        reason: format!("no {kind} is called '{}'", named.name),
    };
    let view = look.view.iter().filter(|v| view_of(&v.name).is_none());
    let panes = look.panes.iter().chain(&look.panels);
    let panes = panes.filter(|p| pane_of(known, &p.name).is_none());
    view.map(|named| unknown("view", named))
        .chain(panes.map(|named| unknown("pane", named)))
        .next()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::panes::PANES;
    use crate::lesson::LESSONS;

    /// A lesson of one step with these settings.
    fn lesson(settings: &str) -> Lesson {
        let text = format!(
            "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n# S\n```toml\nscene = \"tetra\"\n\
             a = \"method=none\"\n{settings}\n```\nText\n"
        );
        Lesson::parse(&text, "t.md").unwrap()
    }

    #[test]
    fn every_lesson_names_what_the_window_has() {
        for known in LESSONS {
            let lesson = known.read();
            let wrong = lesson
                .steps
                .iter()
                .find_map(|step| unknown(&lesson, step, PANES));
            assert_eq!(wrong, None);
        }
    }

    #[test]
    fn names_that_the_window_lacks_are_told_with_their_line() {
        let lesson = lesson("panes = [\n\"Outline\",\n\"Inline\"]");
        let wrong = unknown(&lesson, &lesson.steps[0], PANES).unwrap();
        assert_eq!(wrong.to_string(), "t.md:11: no pane is called 'Inline'");
    }

    #[test]
    fn the_step_decides_what_stands_beside_the_lesson() {
        let slots = |settings: &str, asks| {
            let lesson = lesson(settings);
            super::slots(&lesson.steps[0].subject, asks, PANES)
        };
        let named = "panes = [\"Outline\"]\npanels = [\"Rays of the pixel\"]";
        assert_eq!(slots("", false), [vec!["picture"], vec!["view3d"]]);
        assert_eq!(slots(named, true), [vec!["picture"], vec!["outline"]]);
        let all = vec!["outline", "rays"];
        assert_eq!(slots(named, false), [vec!["picture"], all]);
        let beside = "b = \"method=midpoint\"\nview = \"side by side\"";
        assert_eq!(slots(beside, true), [vec!["picture"]]);
    }
}
