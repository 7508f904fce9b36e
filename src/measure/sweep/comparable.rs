//! Whether the values of a parameter can be compared over rows that several machines measured.

use super::{Origin, Row};
use crate::measure::{Class, Parameter};

/// Why times of rows are not compared: their origins, each with its number of rows.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "{symbol} is not compared: it is a time, and the rows are from different processors, instruction sets or \
     versions, so that ratios of times would compare these and not the trees: {}. Measure all rows on one \
     processor, or compare a count, such as --show N_AT",
    listed(.origins)
)]
pub struct OtherOrigin {
    pub symbol: &'static str,
    pub origins: Vec<(Origin, usize)>,
}

fn listed(origins: &[(Origin, usize)]) -> String {
    let each = origins.iter().map(|(origin, rows)| {
        let noun = if *rows == 1 { "row" } else { "rows" };
        format!("{rows} {noun} from {origin}")
    });
    each.collect::<Vec<_>>().join("; ")
}

/// Checks that the values of a parameter can be compared over these rows. Counts always can.
///
/// # Errors
/// The parameter is a time, and rows were measured by different processors, instruction sets or versions.
pub fn check_comparable(rows: &[Row], parameter: &Parameter) -> Result<(), OtherOrigin> {
    if parameter.class != Class::T {
        return Ok(());
    }
    let mut origins: Vec<(Origin, usize)> = Vec::new();
    for row in rows {
        match origins.iter_mut().find(|(known, _)| *known == row.origin) {
            Some((_, rows)) => *rows += 1,
            None => origins.push((row.origin.clone(), 1)),
        }
    }
    let is_one = (origins.iter().enumerate())
        .all(|(i, (a, _))| origins[..i].iter().all(|(b, _)| a.is_comparable(b)));
    if is_one {
        return Ok(());
    }
    Err(OtherOrigin {
        symbol: parameter.symbol,
        origins,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::measure::sweep::Key;
    use crate::measure::{parameter, parameters};
    use crate::setup::Setup;

    fn row(processor: &str, kernel: &str, instruction_set: &str) -> Row {
        let setup = Setup::default();
        let origin = Origin {
            processor: processor.into(),
            instruction_set: instruction_set.into(),
            kernel: kernel.into(),
            version: "1.0.0".into(),
        };
        Row {
            point: 0,
            points: 1,
            key: Key::of(&setup, &[]),
            origin,
            values: vec![Some(1.0); parameters().len()],
            failure: None,
        }
    }

    #[test]
    fn times_of_two_processors_are_not_compared_and_counts_are() {
        let (time, count) = (parameter("T_TR"), parameter("N_AT"));
        let one = row("A", "scalar", "x86_64");
        let kernels = [one.clone(), row("A", "stream", "AVX2"), one.clone()];
        assert_eq!(check_comparable(&kernels, time), Ok(()));
        assert_eq!(check_comparable(&[], time), Ok(()));
        let mut newer = one.clone();
        newer.origin.version = "2.0.0".into();
        for other in [row("B", "scalar", "x86_64"), newer] {
            let rows = [one.clone(), other.clone(), one.clone()];
            assert_eq!(check_comparable(&rows, count), Ok(()));
            let error = check_comparable(&rows, time).unwrap_err();
            let expected = vec![(one.origin.clone(), 2), (other.origin, 1)];
            assert_eq!(error.origins, expected);
            let text = error.to_string();
            assert!(text.starts_with("T_TR is not compared"), "{text}");
            assert!(text.contains("2 rows from A (scalar, x86_64, version 1.0.0); 1 row from"));
        }
        let sets = [row("A", "stream", "AVX2"), row("A", "stream", "AVX-512")];
        assert!(check_comparable(&sets, time).is_err());
    }
}
