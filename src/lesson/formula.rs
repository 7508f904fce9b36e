//! Formulas and conditions on measured figures, such as `b.N_IT / a.N_IT` and `b.N_LS < 2 *
//! a.N_LS`.

use super::figures::{Figures, Name};
use crate::present::number::{Digits, NO_VALUE, grouped};

/// A number computed from figures.
#[derive(Clone, Debug)]
pub enum Formula {
    Number(f64),
    Figure(Name),
    Of(Box<Formula>, Operator, Box<Formula>),
}

/// An arithmetic operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operator {
    Plus,
    Minus,
    Times,
    Over,
}

/// A comparison of two formulas.
#[derive(Clone, Debug)]
pub struct Condition {
    pub left: Formula,
    pub relation: Relation,
    pub right: Formula,
}

/// A comparison operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Relation {
    Less,
    AtMost,
    Equal,
    AtLeast,
    More,
}

/// The format of a number.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// A single figure with its unit, anything else with four significant digits.
    #[default]
    Plain,
    Percent,
    /// Rounded to a whole number.
    Whole,
}

impl Formula {
    /// Parses a formula.
    ///
    /// # Errors
    /// One sentence on what was expected.
    pub fn parse(text: &str) -> Result<Formula, String> {
        let mut reader = Reader { rest: text };
        let formula = reader.sum()?;
        reader.end()?;
        Ok(formula)
    }

    /// Returns the value; `None` if a figure has no value or on division by zero.
    pub fn value(&self, figures: &Figures) -> Option<f64> {
        self.value_by(&|name| name.value(figures))
    }

    /// Like [`Formula::value`], with a function that returns the values of figures.
    fn value_by(&self, known: &dyn Fn(&Name) -> Option<f64>) -> Option<f64> {
        match self {
            Formula::Number(number) => Some(*number),
            Formula::Figure(name) => known(name),
            Formula::Of(left, operator, right) => {
                let (left, right) = (left.value_by(known)?, right.value_by(known)?);
                match operator {
                    Operator::Plus => Some(left + right),
                    Operator::Minus => Some(left - right),
                    Operator::Times => Some(left * right),
                    Operator::Over => (right != 0.0).then(|| left / right),
                }
            }
        }
    }

    /// Formats a value of this formula; `–` if there is none.
    pub fn write(&self, value: Option<f64>, style: Style) -> String {
        match (value, style, self) {
            (None, ..) => NO_VALUE.into(),
            (Some(value), Style::Percent, _) => Digits::Four.percent(value),
            (Some(value), Style::Whole, _) => grouped(value),
            (Some(value), Style::Plain, Formula::Figure(name)) => name.write(value),
            (Some(value), Style::Plain, _) => Digits::Four.number(value),
        }
    }

    /// Returns all figures in the formula.
    pub fn names(&self) -> Vec<&Name> {
        match self {
            Formula::Number(_) => Vec::new(),
            Formula::Figure(name) => vec![name],
            Formula::Of(left, _, right) => [left.names(), right.names()].concat(),
        }
    }

    /// Returns whether the formula depends on a time, which differs between machines.
    pub fn is_timed(&self) -> bool {
        self.names().iter().any(|name| name.is_timed())
    }
}

impl Condition {
    /// Parses two formulas with one of `<`, `<=`, `=`, `>=` and `>` between them.
    ///
    /// # Errors
    /// One sentence on what was expected.
    pub fn parse(text: &str) -> Result<Condition, String> {
        let mut reader = Reader { rest: text };
        let left = reader.sum()?;
        let relations = [
            ("<=", Relation::AtMost),
            (">=", Relation::AtLeast),
            ("<", Relation::Less),
            (">", Relation::More),
            ("=", Relation::Equal),
        ];
        let found = relations.into_iter().find(|(sign, _)| reader.take(sign));
        let (_, relation) = found.ok_or_else(|| reader.expected("<, <=, =, >= or >"))?;
        let right = reader.sum()?;
        reader.end()?;
        Ok(Condition {
            left,
            relation,
            right,
        })
    }

    /// Returns whether the condition holds; `None` if a side has no value.
    pub fn holds(&self, figures: &Figures) -> Option<bool> {
        let (left, right) = (self.left.value(figures)?, self.right.value(figures)?);
        Some(match self.relation {
            Relation::Less => left < right,
            Relation::AtMost => left <= right,
            Relation::Equal => left == right,
            Relation::AtLeast => left >= right,
            Relation::More => left > right,
        })
    }

    /// Returns both sides.
    pub fn sides(&self) -> [&Formula; 2] {
        [&self.left, &self.right]
    }
}

/// A recursive-descent parser; `rest` is the remaining text.
struct Reader<'a> {
    rest: &'a str,
}

impl Reader<'_> {
    fn sum(&mut self) -> Result<Formula, String> {
        let mut left = self.product()?;
        loop {
            let operator = if self.take("+") {
                Operator::Plus
            } else if self.take("-") {
                Operator::Minus
            } else {
                return Ok(left);
            };
            left = Formula::Of(Box::new(left), operator, Box::new(self.product()?));
        }
    }

    fn product(&mut self) -> Result<Formula, String> {
        let mut left = self.single()?;
        loop {
            let operator = if self.take("*") {
                Operator::Times
            } else if self.take("/") {
                Operator::Over
            } else {
                return Ok(left);
            };
            left = Formula::Of(Box::new(left), operator, Box::new(self.single()?));
        }
    }

    fn single(&mut self) -> Result<Formula, String> {
        if self.take("(") {
            let inner = self.sum()?;
            return match self.take(")") {
                true => Ok(inner),
                false => Err(self.expected("')'")),
            };
        }
        let belongs = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '.';
        let end = self.rest.find(|c| !belongs(c)).unwrap_or(self.rest.len());
        let (word, rest) = self.rest.split_at(end);
        if word.is_empty() {
            return Err(self.expected("a number, a figure such as a.N_LS, or '('"));
        }
        let formula = if word.starts_with(|c: char| c.is_ascii_digit()) {
            let number = word.parse();
            Formula::Number(number.map_err(|_| format!("'{word}' is not a number"))?)
        } else {
            Formula::Figure(Name::parse(word)?)
        };
        self.rest = rest;
        self.skip_space();
        Ok(formula)
    }

    /// Consumes a token if it comes next.
    fn take(&mut self, sign: &str) -> bool {
        self.skip_space();
        let rest = self.rest.strip_prefix(sign);
        self.rest = rest.unwrap_or(self.rest);
        self.skip_space();
        rest.is_some()
    }

    fn skip_space(&mut self) {
        self.rest = self.rest.trim_start();
    }

    fn end(&self) -> Result<(), String> {
        match self.rest.is_empty() {
            true => Ok(()),
            false => Err(self.expected("an operator or the end")),
        }
    }

    fn expected(&self, what: &str) -> String {
        match self.rest {
            "" => format!("expected {what}, found the end"),
            rest => format!("expected {what}, found '{rest}'"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::figures::Side;
    use super::*;

    /// Evaluates a formula without figures.
    fn value(text: &str) -> Option<f64> {
        Formula::parse(text).unwrap().value_by(&|_| None)
    }

    #[test]
    fn products_bind_tighter_and_operators_are_left_associative() {
        assert_eq!(value("1 + 2 * 3"), Some(7.0));
        assert_eq!(value("(1+2)*3"), Some(9.0));
        assert_eq!(value("8 / 4 / 2 - 3 - 1"), Some(-3.0));
        assert_eq!(value("0.5"), Some(0.5));
        assert_eq!(value("1 / (2 - 2)"), None);
        assert_eq!(value("1 + a.N_LS"), None);
    }

    #[test]
    fn errors_say_what_was_expected() {
        for (text, reason) in [
            ("", "found the end"),
            ("1 +", "found the end"),
            ("(1", "expected ')'"),
            ("1 2", "expected an operator or the end, found '2'"),
            ("1.2.3", "'1.2.3' is not a number"),
            ("a.N_XYZ", "N_XYZ"),
            ("c.N_LS", "c.N_LS"),
            ("N_LS", "N_LS"),
        ] {
            let error = Formula::parse(text).unwrap_err();
            assert!(error.contains(reason), "{text}: {error}");
        }
        let error = Condition::parse("a.N_LS").unwrap_err();
        assert!(error.contains("expected <, <=, =, >= or >"), "{error}");
        assert!(Condition::parse("a.N_LS <= b.N_LS + 1").is_ok());
        assert!(Condition::parse("1 < 2 < 3").is_err());
    }

    #[test]
    fn formulas_with_times_are_recognized() {
        assert!(Formula::parse("b.T_TR / a.T_TR").unwrap().is_timed());
        assert!(!Formula::parse("b.N_LS / a.N_LS").unwrap().is_timed());
        assert_eq!(
            Formula::parse("1 + b.N_LS").unwrap().names()[0].side(),
            Some(Side::B)
        );
    }
}
