#![allow(missing_docs)]
use twofold::propagation::splitting::*; use twofold::propagation::*; use twofold::dynamics::*;
use nalgebra::*;
fn main(){
 let n=Vector3::new(0.8746095252119437249021,0.,0.4848279884748181220954); let l=Vector3::new(0.5853075298090915055344,0.,1.21297547425160641252);
 let sc:f64=std::env::args().nth(1).map_or(1.0,|x|x.parse().unwrap());
 let s=Matrix3::from_diagonal(&(Vector3::new(0.02,0.01,-0.04)*sc));
 let sp=RigidSpheroid::in_units_of_tc(1.1); let st=AxisState{axis:n,momentum:l};
 let tay=propagate_axis(&sp,&s,&st,(0.,1000.),1e-15).unwrap(); let rf=tay.axis_state(1000.).unwrap().axis;
 for sc in SCHEMES { let mut prev=0.0; for k in 0..8 { let h=2.0/1.5f64.powi(k)*sc.stages() as f64/5.0;
  let mut best=1e9f64; let mut e=0.0;
  for _ in 0..5 { let t=std::time::Instant::now(); let m=propagate_by_splitting(&sp,&s,&st,(0.,1000.),sc,h).unwrap(); best=best.min(t.elapsed().as_secs_f64()); 
  e=(m.axis_state(1000.).unwrap().axis-rf).amax();}
  let c=(1000.0/h).ceil();
  println!("{} h {:.3} err {:.2e} ms {:.3} ns/stage {:.2} order {:.1}",sc.name,h,e,best*1e3,best*1e9/(c*sc.stages() as f64),(prev/e as f64).ln()/1.5f64.ln()); prev=e;
 }}
}
