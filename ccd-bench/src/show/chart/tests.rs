use super::plane::decade_range;
use super::*;
use plotters::style::RGBColor;

const SCENES: [&str; 3] = ["knot2880", "knot34560", "never measured"];
const METHODS: [ChartedMethod<'_>; 3] = [
    ChartedMethod {
        name: "ours",
        method_family: MethodFamily::ThisProject,
    },
    ChartedMethod {
        name: "careless <peer> & co",
        method_family: MethodFamily::Peer,
    },
    ChartedMethod {
        name: "absent",
        method_family: MethodFamily::Rival,
    },
];

fn cell(scene: &str, method: &str, tolerance: f64) -> MeasurementCell {
    MeasurementCell {
        scene: scene.to_owned(),
        method: method.to_owned(),
        tolerance,
        rows: 100,
        median_us: 50.0 - tolerance.log10(),
        mean_us: 60.0,
        p95_us: 100.0,
        late: 0,
        missed: 0,
        false_contacts: 0,
        unresolved: 0,
        mean_error: Some(0.3 * tolerance),
        max_error: Some(tolerance),
        early: 0,
        cut_off: 0,
        undecided: 0,
        mean_steps: 4.0,
    }
}

/// Returns measurements of three methods on two scenes; the method named careless misses a contact in one of them.
fn cells() -> Vec<MeasurementCell> {
    let mut cells = Vec::new();
    for scene in &SCENES[..2] {
        for method in ["ours", "careless <peer> & co", "over patches"] {
            cells.extend([1e-1, 1e-3, 1e-6].map(|tolerance| cell(scene, method, tolerance)));
        }
    }
    for cell in &mut cells {
        if (cell.scene.as_str(), cell.method.as_str()) == ("knot2880", "careless <peer> & co") {
            cell.missed = 1;
        }
    }
    cells
}

fn chart_data(cells: &[MeasurementCell]) -> ChartData<'_> {
    ChartData {
        cells,
        scenes: &SCENES,
        methods: &METHODS,
    }
}

fn svg(cells: &[MeasurementCell]) -> String {
    chart_data(cells).draw_pareto_chart().unwrap().unwrap()
}

#[test]
fn the_chart_names_what_it_shows() {
    let svg = svg(&cells());
    assert!(svg.contains("ours"));
    for other in ["patches", "absent", "never measured"] {
        assert!(!svg.contains(other), "{other}");
    }
}

#[test]
fn names_are_escaped_and_no_number_is_lost() {
    let mut cells = cells();
    cells[0].mean_error = None;
    cells[1].median_us = f64::NAN;
    cells[2].mean_error = Some(0.0);
    cells[3].mean_steps = f64::INFINITY;
    cells[4].unresolved = cells[4].rows;
    let svg = svg(&cells);
    for lost in ["NaN", "inf", "<peer>", "& co"] {
        assert!(!svg.contains(lost), "{lost}");
    }
    assert!(svg.contains("careless &lt;peer&gt; &amp; co (unsafe)"));
}

#[test]
fn an_unsafe_method_is_in_the_strip_only() {
    let safe = cells();
    let mut careful = safe.clone();
    for cell in &mut careful {
        cell.missed = 0;
    }
    // Peers draw a shape of this colour.
    let RGBColor(red, green, blue) = style::method_styles(&METHODS, |_| false)[1].colour;
    let colour = format!("#{red:02X}{green:02X}{blue:02X}");
    let lines = |cells: &[MeasurementCell]| {
        let text = svg(cells);
        let of_colour = text.lines().filter(|line| line.contains(&colour));
        // Dashes of lines through data, and filled markers.
        let filled = format!("fill=\"{colour}\"");
        let (solid, hollow): (Vec<_>, Vec<_>) = of_colour.partition(|line| line.contains(&filled));
        (solid.len(), hollow.len(), text.contains(">\nunsafe\n<"))
    };
    let (solid, _, strip) = lines(&safe);
    assert_eq!((solid, strip), (0, true), "no filled marker, and a strip");
    let (solid, _, strip) = lines(&careful);
    // Two scenes, three tolerances, and the legend.
    assert_eq!((solid, strip), (7, false));
}

#[test]
fn empty_tables_are_an_error_and_strange_ones_do_not_panic() {
    let empty = chart_data(&[]).draw_pareto_chart();
    assert!(empty.unwrap_err().to_string().contains("nothing to draw"));
    let unknown_cells = [cell("elsewhere", "nobody", 1e-3)];
    let unknown = chart_data(&unknown_cells).draw_pareto_chart();
    assert!(unknown.unwrap_err().to_string().contains("nothing to draw"));
    let mut lost = [cell("knot2880", "ours", f64::NAN)];
    lost[0].median_us = f64::NAN;
    lost[0].mean_error = None;
    lost[0].mean_steps = f64::NAN;
    assert_eq!(chart_data(&lost).draw_pareto_chart().unwrap(), None);
}

#[test]
fn no_two_methods_look_alike() {
    let methods: Vec<_> = [
        MethodFamily::ThisProject,
        MethodFamily::Rival,
        MethodFamily::Peer,
    ]
    .into_iter()
    .flat_map(|family| {
        [ChartedMethod {
            name: "",
            method_family: family,
        }; 10]
    })
    .collect();
    let styles = style::method_styles(&methods, |_| false);
    for (index, style) in styles.iter().enumerate() {
        assert!(!styles[..index].contains(style), "{index}");
    }
}

#[test]
fn axes_cover_their_values() {
    let range = decade_range([3e-7, 0.5].into_iter()).unwrap();
    assert!(range.start <= 3e-7 && range.start > 3e-8, "{range:?}");
    assert!(range.end >= 0.5 && range.end < 5.0, "{range:?}");
    let range = decade_range([10.0].into_iter()).unwrap();
    assert!(
        range.end > 9.0 * range.start,
        "at least a decade: {range:?}"
    );
    assert!(decade_range([0.0, f64::NAN, f64::INFINITY].into_iter()).is_none());
}
