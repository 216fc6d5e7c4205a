//! scratch
use ccd_tests::case::Case;
use ccd_tests::referee::*;
use ccd_core::Outcome;
use ccd_tests::backends::*;
fn main() {
    let text = std::fs::read_to_string(std::env::args().nth(1).unwrap()).unwrap();
    let case: Case = toml::from_str(&text).unwrap();
    let q = case.query();
    let a = default_answer(&q, &case.config());
    println!("{a:?}");
    let r = Referee::with_margin(&q, case.margin);
    println!("{:?}", r.verdict());
    if let Outcome::Contact{time, contact} = a.outcome {
        println!("gap at t {}", r.gap(time));
        let bodies = q.triangles();
        println!("{:?}", ccd_tests::checks::check_contact(&q, time, &contact, &bodies, 1.0));
        // brute force sample
        let p = Placement::pair(&q);
        let (ma, mb) = (&q.a.shape.mesh, &q.b.shape.mesh);
        let mut best = f64::INFINITY;
        for f in 0..ma.faces.len() { for g in 0..mb.faces.len() {
            let s = ma.triangle(f).map(|x| p[0].at(time, x)); let t = mb.triangle(g).map(|x| p[1].at(time, x));
            for i in 0..60 { for j in 0..60-i {
               let w = [i as f64/59.0, j as f64/59.0]; let x = s[0]*(1.0-w[0]-w[1])+s[1]*w[0]+s[2]*w[1];
               let y = point_triangle(x, t); if y.distance(x) < best { best = y.distance(x); println!("{best} {f} {g}"); } } } } }
    }
}
