use super::*;

fn draw_map(kind: &'static HeatMapTexts, cells: Vec<Option<HeatCell>>) -> String {
    let map = HeatMap {
        captions: kind,
        methods: vec!["ours".to_owned(), "theirs".to_owned(), "absent".to_owned()],
        rows: vec![HeatRow {
            name: "bullet and paper".to_owned(),
            parameter_description: "way against thickness".to_owned(),
            cells,
        }],
    };
    map.draw().unwrap()
}

fn count_fills(svg: &str, colour: &str) -> usize {
    svg.matches(&format!("fill=\"{colour}\"")).count()
}

#[test]
fn a_map_has_all_names_and_the_colour_of_each_worst_answer() {
    let cell = |worst, fraction, limit: &str| {
        Some(HeatCell::solved_range_cell(
            worst,
            fraction,
            limit.to_owned(),
        ))
    };
    let right = cell(Verdict::Right, 1.0, "");
    let svg = draw_map(
        SOLVED_RANGE_TEXTS,
        vec![right, cell(Verdict::Missed, 0.25, "1e5"), None],
    );
    for text in [
        "bullet and paper",
        "way against thickness",
        "theirs",
        "missed",
        "1e5",
    ] {
        assert!(svg.contains(text), "{text}");
    }
    // The counts include the legend: a right cell and two bars; a missed cell.
    assert_eq!(
        (count_fills(&svg, "#0072B2"), count_fills(&svg, "#D55E00")),
        (4, 2),
        "{svg}"
    );
}

#[test]
fn costs_that_grow_are_darker() {
    let cells = [1.0, 2000.0].map(|factor| Some(HeatCell::cost_growth_cell(factor)));
    let svg = draw_map(COST_GROWTH_TEXTS, cells.into_iter().chain([None]).collect());
    assert_eq!(
        (count_fills(&svg, "#EAF2F8"), count_fills(&svg, "#102F54")),
        (2, 2),
        "{svg}"
    );
    assert!(svg.contains("1.0") && svg.contains("2000"));
}
