//! Statistics that `ccd decompose` prints about a mesh and its pieces.

use crate::console::printable::PrintableText;
use ccd_core::{Body, Solidity};
use ccd_decomp::{StoredBodyContent, Unit};
use indicatif::HumanCount;
use serde::Serialize;
use std::fmt;

/// The statistics of a mesh and its pieces; displayed as aligned lines.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub(super) struct Statistics {
    mesh: String,
    unit: Option<&'static str>,
    pieces_kind: String,
    why: String,
    triangles: usize,
    pieces: usize,
    virtual_faces: usize,
    tree_nodes: usize,
    hulls: usize,
    build_ms: f64,
    bytes: usize,
    exact: bool,
    excess: f64,
    volume: &'static str,
    remarks: String,
}

impl Statistics {
    pub(super) fn new(
        (mesh, unit): (String, Option<Unit>),
        model: &StoredBodyContent,
        body: &Body,
        build_ms: f64,
    ) -> Self {
        let report = &model.report;
        Statistics {
            mesh,
            unit: unit.map(Unit::symbol),
            pieces_kind: report.kind.to_string(),
            why: report.reason.to_string(),
            triangles: report.triangles,
            pieces: report.pieces,
            virtual_faces: report.virtual_facets,
            tree_nodes: report.tree_nodes,
            hulls: model
                .hull_tree
                .as_ref()
                .map_or(0, |tree| tree.hulls().len()),
            // Round to the microsecond.
            build_ms: (build_ms * 1e3).round() / 1e3,
            bytes: body.memory_usage(),
            exact: report.is_exact(),
            excess: report.excess,
            volume: match report.volume {
                Solidity::Solid => "solid",
                Solidity::Surface => "surface",
            },
            remarks: report.remarks(),
        }
    }
}

impl fmt::Display for Statistics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let triangles = human_count(self.triangles);
        let lines = [
            ("mesh", format!("{}: {triangles} triangles", self.mesh)),
            ("unit", self.unit.unwrap_or_default().to_owned()),
            ("remarks", self.remarks.clone()),
            ("pieces", self.pieces_text()),
            ("why", self.why.clone()),
            ("virtual faces", human_count(self.virtual_faces).to_string()),
            ("tree nodes", self.tree_text()),
            ("build", format!("{:.1} ms", self.build_ms)),
            ("memory", format!("{:.1} MB", self.bytes as f64 / 1e6)),
        ];
        for (name, value) in lines.iter().filter(|(_, value)| !value.is_empty()) {
            writeln!(f, "{name:<14}{}", PrintableText(value))?;
        }
        write!(f, "{:<14}{}", "error", self.excess_text())
    }
}

impl Statistics {
    fn pieces_text(&self) -> String {
        let pieces = format!("{} {}", human_count(self.pieces), self.pieces_kind);
        if self.exact {
            format!("{pieces}, {}", self.volume)
        } else {
            pieces
        }
    }

    fn tree_text(&self) -> String {
        let nodes = human_count(self.tree_nodes);
        match self.hulls {
            0 => nodes.to_string(),
            hulls => format!("{nodes}, {} hulls", human_count(hulls)),
        }
    }

    fn excess_text(&self) -> String {
        if self.exact {
            "none: the pieces are exact".to_owned()
        } else {
            format!("the pieces stick out by at most {:.3e}", self.excess)
        }
    }
}

fn human_count(count: usize) -> HumanCount {
    HumanCount(count as u64)
}
