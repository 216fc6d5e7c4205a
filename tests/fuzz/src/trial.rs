//! Answers one query by many methods, and judges the answers.

use crate::case::{Case, MeshClass, Shape};
use crate::engine::{Bodies, HullTrees, Method, PieceKind};
use crate::judge::{Fault, Judge, MethodAnswer};
use ccd_core::{Outcome, Settings};
use std::collections::HashMap;
use std::fmt;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// A case with the outcomes of all methods, and the failures among them.
pub struct Trial {
    pub case: Case,
    pub methods: Vec<(PieceKind, Method)>,
    pub outcomes: Vec<Outcome>,
    /// The reason why the engine or the decomposition rejected the case, if it did.
    pub refusal_reason: Option<String>,
    pub failures: Vec<Failure>,
    /// Whether the referee's search for an earlier contact was complete.
    pub is_search_complete: bool,
}

/// A wrong answer or a panic of one method. A wrong answer has the outcomes of all methods, a panic has none.
#[derive(Clone, Debug)]
pub struct Failure {
    pub fault: Fault,
    pub kind_and_method: (PieceKind, Method),
    pub text: String,
    pub outcomes: String,
}

impl fmt::Display for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for ((kind, method), outcome) in self.methods.iter().zip(&self.outcomes) {
            writeln!(f, "{kind} {method}: {outcome:?}")?;
        }
        f.write_str(&self.case.reproducer())
    }
}

impl Failure {
    /// Returns the text of the failure, with the command that repeats its query.
    pub fn report(&self, command: &str, case: &Case) -> String {
        let Failure {
            fault,
            kind_and_method: (kind, method),
            text,
            outcomes,
        } = self;
        let Settings {
            margin, tolerance, ..
        } = case.config;
        format!(
            "{fault:?} {kind} {method}, margin {margin:e}, tolerance {tolerance:e}\n{text}\n{outcomes}\
             {command}\n{}",
            case.reproducer()
        )
    }
}

/// Builds the bodies of a case, runs the methods, and judges their answers.
///
/// `when_answered` is called before the judge begins, who may take longer than all methods.
pub fn run_and_judge(
    case: Case,
    methods: Vec<(PieceKind, Method)>,
    when_answered: impl FnOnce(),
) -> Trial {
    let mut trial = Trial {
        case,
        methods: Vec::new(),
        outcomes: Vec::new(),
        refusal_reason: None,
        failures: Vec::new(),
        is_search_complete: true,
    };
    let built = build_bodies(&mut trial, &methods);
    let given = solve_by_methods(&mut trial, &built, methods);
    when_answered();
    trial.methods = given.iter().map(|g| (g.bodies.kind, g.method)).collect();
    trial.outcomes = given.iter().map(|g| g.answer.outcome).collect();
    judge(&mut trial, &given);
    trial
}

/// Builds the bodies of every kind that the methods need.
fn build_bodies(
    trial: &mut Trial,
    methods: &[(PieceKind, Method)],
) -> Vec<((PieceKind, HullTrees), Bodies)> {
    let mut built: Vec<((PieceKind, HullTrees), Bodies)> = Vec::new();
    for (kind, method) in methods {
        let key = (*kind, method.trees());
        if built.iter().any(|(k, _)| *k == key) {
            continue;
        }
        match catch_unwind(|| Bodies::new(&trial.case, key.0, key.1)) {
            Ok(Ok(bodies)) => built.push((key, bodies)),
            Ok(Err(why)) => trial.refusal_reason = Some(why),
            Err(panic) => trial
                .failures
                .push(failure_of_panic(&*panic, (*kind, *method))),
        }
    }
    built
}

/// Returns the answers of all methods that accept the case.
fn solve_by_methods<'b>(
    trial: &mut Trial,
    built: &'b [((PieceKind, HullTrees), Bodies)],
    methods: Vec<(PieceKind, Method)>,
) -> Vec<MethodAnswer<'b>> {
    let mut given = Vec::new();
    for (kind, method) in methods {
        let bodies = built.iter().find(|(k, _)| *k == (kind, method.trees()));
        let Some((_, bodies)) = bodies else { continue };
        let settings = settings_for(&trial.case, method);
        let problem = match bodies.problem(&trial.case, &settings) {
            Ok(problem) => problem,
            Err(why) => {
                trial.refusal_reason = Some(why);
                continue;
            }
        };
        match catch_unwind(AssertUnwindSafe(|| method.solve(&problem))) {
            Ok(answer) => given.push(MethodAnswer {
                bodies,
                method,
                answer,
            }),
            Err(panic) => trial
                .failures
                .push(failure_of_panic(&*panic, (kind, method))),
        }
    }
    given
}

/// Judges the answers, and records their faults in the trial.
fn judge(trial: &mut Trial, given: &[MethodAnswer<'_>]) {
    let Some(first) = given.first() else { return };
    let volumes = [0, 1].map(|k| first.bodies.bodies[k].solidity());
    let judge = Judge::new(&trial.case, volumes, rounding(&trial.case, first.bodies));
    let (faults, proven) = judge.faults(given);
    let outcomes: String = given
        .iter()
        .map(|g| format!("  {} {}: {:?}\n", g.bodies.kind, g.method, g.answer.outcome))
        .collect();
    let failures = faults.into_iter().map(|(k, fault, text)| Failure {
        fault,
        kind_and_method: (given[k].bodies.kind, given[k].method),
        text,
        outcomes: outcomes.clone(),
    });
    trial.failures.extend(failures);
    trial.is_search_complete = proven;
}

/// Returns the settings of a case for a method. Schedules with one step for all pairs get a smaller budget.
fn settings_for(case: &Case, method: Method) -> Settings {
    let most = match method {
        Method::Naive | Method::Fast => 200_000,
        _ => u64::MAX,
    };
    Settings {
        budget: case.config.budget.min(most),
        ..case.config.clone()
    }
}

/// Returns the engine's allowance for rounding, which is the least tolerance that it accepts.
fn rounding(case: &Case, bodies: &Bodies) -> f64 {
    let least = Settings {
        tolerance: 1e-100,
        ..case.config.clone()
    };
    bodies.problem(case, &least).map_or(0.0, |p| p.tolerance())
}

fn failure_of_panic(panic: &(dyn std::any::Any + Send), by: (PieceKind, Method)) -> Failure {
    let text = panic.downcast_ref::<String>().cloned();
    let text = text.or_else(|| panic.downcast_ref::<&str>().map(|&s| s.to_owned()));
    Failure {
        fault: Fault::Panic,
        kind_and_method: by,
        text: text.unwrap_or_default(),
        outcomes: String::new(),
    }
}

/// Returns a smaller case that fails in the same way: without triangles that the failure does not need.
pub fn shrink(case: &Case, failure: &Failure) -> Case {
    let fails = |case: &Case| {
        let mut methods = vec![(PieceKind::Triangles, Method::Direct)];
        methods.push(failure.kind_and_method);
        let again = run_and_judge(case.clone(), methods, || {});
        again.failures.iter().any(|f| f.fault == failure.fault)
    };
    let mut case = case.clone();
    if case
        .shapes
        .iter()
        .any(|s| s.mesh_class == MeshClass::VertexHull)
    {
        return case;
    }
    for side in [0, 1] {
        let mut face = 0;
        while face < case.shapes[side].faces.len() && case.shapes[side].faces.len() > 1 {
            let mut fewer = case.clone();
            fewer.shapes[side].faces.remove(face);
            fewer.shapes[side].mesh_class = MeshClass::TriangleSoup;
            fewer.shapes[side] = without_unused_vertices(&fewer.shapes[side]);
            if fails(&fewer) {
                case = fewer;
            } else {
                face += 1;
            }
        }
    }
    case
}

/// Returns the shape without the vertices that no face uses.
fn without_unused_vertices(shape: &Shape) -> Shape {
    let mut new = HashMap::new();
    let mut out = Shape {
        mesh_class: shape.mesh_class,
        ..Shape::default()
    };
    for face in &shape.faces {
        out.faces.push(face.map(|v| {
            *new.entry(v).or_insert_with(|| {
                out.vertices.push(shape.vertices[v as usize]);
                out.vertices.len() as u32 - 1
            })
        }));
    }
    out
}
