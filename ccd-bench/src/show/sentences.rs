//! Describes the findings of an evaluation in a few sentences.

#[cfg(test)]
mod tests;

use crate::run::measured::Cell;
use crate::show::chart::{Family, MethodFacts, SceneFacts};
use crate::show::comparable::Reference;
use ccd_core::order::{greater, lesser};

/// The measurements that the sentences describe.
#[derive(Clone, Copy, Debug)]
pub struct Measurements<'a> {
    /// The scenes that were measured.
    pub scenes: &'a [SceneFacts<'a>],
    /// The methods that give answers, in their usual order.
    pub methods: &'a [MethodFacts<'a>],
    /// The measurements of every method on every scene at every tolerance.
    pub cells: &'a [Cell],
    /// The method with which times are compared.
    pub reference: &'a Reference<'a>,
    /// The tolerance at which times are compared.
    pub tolerance: f64,
}

/// The families of methods in the order of the sentences, with their names.
const FAMILIES: [(Family, &str); 4] = [
    (Family::Ours, "This project"),
    (Family::Model, "This project, bodies of other pieces"),
    (Family::Rival, "Published rivals, built here"),
    (Family::Peer, "Libraries"),
];

impl Measurements<'_> {
    /// Returns sentences on the queries, on the answers of each family, and on their times.
    pub fn sentences(&self) -> Vec<String> {
        let mut told = vec![self.describe_queries()];
        told.extend(
            FAMILIES
                .iter()
                .filter_map(|&(family, name)| self.describe_errors(family, name)),
        );
        told.extend(self.describe_own_time());
        told.extend(self.describe_time_ratios());
        told
    }

    fn describe_queries(&self) -> String {
        let sizes = self.scenes.iter().map(|scene| scene.triangles);
        let rows: usize = self.cells.iter().map(|cell| cell.rows).sum();
        format!(
            "{} scenes, with moving bodies of {} to {} triangles; {} methods answered {rows} queries, each compared \
             with a certified bracket of the exact first contact.",
            self.scenes.len(),
            sizes.clone().min().unwrap_or_default(),
            sizes.max().unwrap_or_default(),
            self.methods.len(),
        )
    }

    /// Describes the errors in the answers of a family; `None` if it has no methods.
    fn describe_errors(&self, family: Family, name: &str) -> Option<String> {
        let methods = self.methods.iter().filter(|method| method.family == family);
        let (mut count, mut rows, mut open, mut wrong) = (0, 0, 0, Vec::new());
        for MethodFacts { name: method, .. } in methods {
            let sum = |number: fn(&Cell) -> usize| self.cells_of(method).map(number).sum::<usize>();
            count += 1;
            rows += sum(|cell| cell.rows);
            open += sum(|cell| cell.unresolved);
            let faults = [
                (sum(|cell| cell.late), "late"),
                (sum(|cell| cell.missed), "missed"),
                (sum(|cell| cell.false_contacts), "false"),
                (sum(|cell| cell.early), "early"),
            ];
            let faults = faults.iter().filter(|(number, _)| *number > 0);
            let faults: Vec<String> = faults
                .map(|(number, what)| format!("{number} {what}"))
                .collect();
            if !faults.is_empty() {
                wrong.push(format!("{method} {}", faults.join(", ")));
            }
        }
        let wrong = if wrong.is_empty() {
            "no contact late, missed, false or early".to_owned()
        } else {
            wrong.join("; ")
        };
        (count > 0).then(|| {
            format!("{name} ({count} of the methods, {rows} queries): {wrong}; {open} unresolved.")
        })
    }

    /// Describes the time of a query with the reference method.
    fn describe_own_time(&self) -> Option<String> {
        let name = self.reference.name();
        let medians = || {
            self.cells_of(name)
                .filter(|cell| self.is_compared(cell))
                .map(|cell| cell.median_us)
        };
        let least = medians().reduce(lesser)?;
        let most = medians().reduce(greater)?;
        Some(format!(
            "A query of `{name}`, the default, takes {least:.0} to {most:.0} µs by scene: medians, at tolerance {:e}.",
            self.tolerance
        ))
    }

    /// Describes the ratios of the other methods' times to the reference's, from scene to scene.
    fn describe_time_ratios(&self) -> Option<String> {
        let others = self
            .methods
            .iter()
            .filter(|method| matches!(method.family, Family::Rival | Family::Peer));
        let times = others.filter_map(|MethodFacts { name: method, .. }| {
            let cells = || self.cells_of(method).filter(|cell| self.is_compared(cell));
            let ratios = || cells().filter_map(|cell| self.reference.ratio(cell));
            let (least, most) = (ratios().reduce(lesser)?, ratios().reduce(greater)?);
            // The time of a stopped query is unknown.
            let at_least = if cells().any(|cell| cell.cut_off > 0) {
                "at least "
            } else {
                ""
            };
            Some(format!(
                "{method} {at_least}{} to {}",
                two_digits(least),
                two_digits(most)
            ))
        });
        let times: Vec<String> = times.collect();
        (!times.is_empty())
            .then(|| format!("Times that, on the same queries: {}.", times.join("; ")))
    }

    fn cells_of(&self, method: &str) -> impl Iterator<Item = &Cell> {
        self.cells.iter().filter(move |cell| cell.method == method)
    }

    fn is_compared(&self, cell: &Cell) -> bool {
        cell.tolerance == self.tolerance
    }
}

fn two_digits(value: f64) -> String {
    match value {
        ..10.0 => format!("{value:.1}"),
        _ => format!("{value:.0}"),
    }
}
