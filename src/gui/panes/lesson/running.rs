//! The lesson that is taken: at which step, what was predicted, and what was there before it.

use crate::gui::document::comparing::{View, Which};
use crate::gui::document::{Current, Document, Wanted};
use crate::gui::edits::Request;
use crate::gui::pane::{Cx, Entry};
use crate::lesson::{
    Answer, Difference, Figures, Lesson, LessonError, Named, Prediction, SideFigures, Step,
    Subject, Verdict,
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
    /// What became of the prediction; `None` until the answer is told.
    pub verdict: Option<Verdict>,
}

/// What there was before the lesson.
struct Before {
    wanted: Wanted,
    which: Which,
    view: View,
    heatmap: Option<usize>,
    pixel: Option<[u32; 2]>,
    /// The task that was open.
    task: &'static str,
}

impl Running {
    /// Takes the first step.
    ///
    /// # Errors
    /// The first name that the window has nothing for, with its line.
    pub fn begin(lesson: Lesson, cx: &mut Cx<'_>) -> Result<Running, LessonError> {
        if let Some(error) = lesson
            .steps
            .iter()
            .find_map(|step| unknown(&lesson, step, cx.panes))
        {
            return Err(error);
        }
        let doc = &*cx.doc;
        let before = Before {
            wanted: doc.all_wanted(),
            which: doc.which,
            view: doc.comparing.view,
            heatmap: doc.heatmap,
            pixel: doc.current.as_ref().and_then(Current::picked_pixel),
            task: doc.task,
        };
        let mut running = Running {
            at: 0,
            taken: vec![Taken::default(); lesson.steps.len()],
            wanted: wanted_of(&lesson.steps[0].subject, cx.doc),
            picked: false,
            is_new: true,
            before,
            lesson,
        };
        running.set_up(cx);
        Ok(running)
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

    /// Whether a prediction is still to be made.
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
    pub fn reveal(&mut self, cx: &mut Cx<'_>) {
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
        let subject = &self.lesson.steps[self.at].subject;
        self.wanted = wanted_of(subject, cx.doc);
        self.picked = false;
        self.is_new = true;
        cx.doc.want(self.wanted.clone());
        cx.doc.show(Which::A);
        let view = subject.look.view.as_ref();
        if let Some(view) = view.and_then(|named| view_of(&named.name)) {
            cx.doc.comparing.view = view;
        }
        for named in subject.look.panes.iter().chain(&subject.look.panels) {
            if let Some(pane) = pane_of(cx.panes, &named.name) {
                cx.edits.request(Request::Show(pane.id));
            }
        }
        self.look(cx);
    }

    /// Shows what comes with the answer, or not yet.
    fn look(&self, cx: &mut Cx<'_>) {
        let look = &self.step().subject.look;
        let told = look.heatmap.filter(|_| !self.asks());
        let place = told.and_then(|symbol| heatmaps().iter().position(|h| h.symbol == symbol));
        cx.doc.heatmap = place;
    }

    /// Picks the step's pixel once its picture is there, and takes the figures once they are final.
    pub fn follow(&mut self, cx: &mut Cx<'_>) {
        let doc = &mut *cx.doc;
        let subject = &self.lesson.steps[self.at].subject;
        let is_wanted = |current: &&Current, wanted: &Setup| current.shown.setup == *wanted;
        if let (Some(pixel), false) = (subject.pixel, self.picked)
            && let [Some(a), _] = doc.both_mut()
            && is_wanted(&&*a, &self.wanted.a)
        {
            a.pick(pixel);
            self.picked = true;
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

    /// How many predictions were right, of how many whose answers were told.
    pub fn score(&self) -> (usize, usize) {
        let told = self.taken.iter().filter_map(|taken| taken.verdict.as_ref());
        let right = told.clone().filter(|verdict| verdict.is_right()).count();
        (right, told.count())
    }

    /// Brings back what there was before.
    pub fn restore(self, cx: &mut Cx<'_>) {
        let Before {
            wanted,
            which,
            view,
            heatmap,
            pixel,
            task,
        } = self.before;
        cx.doc.want(wanted);
        cx.doc.show(which);
        cx.doc.comparing.view = view;
        cx.doc.heatmap = heatmap;
        cx.edits.request(Request::Task(task));
        if let Some(current) = &mut cx.doc.current {
            match pixel {
                Some(pixel) => current.pick(pixel),
                None => current.unpick(),
            }
        }
    }
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
        let text = "+++\ntitle = \"T\"\nabout = \"A\"\n+++\n# S\n```toml\nscene = \"tetra\"\n\
                    a = \"method=none\"\npanes = [\n\"Outline\",\n\"Inline\"]\n```\nText\n";
        let lesson = Lesson::parse(text, "t.md").unwrap();
        let wrong = unknown(&lesson, &lesson.steps[0], PANES).unwrap();
        assert_eq!(wrong.to_string(), "t.md:11: no pane is called 'Inline'");
    }
}
