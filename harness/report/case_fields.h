// The fields of a case of a report, in the order of the file; report_json.cpp has those of the rest.
#pragma once

#include "report/json_archive.h"

namespace vsglbench {

void fields(auto& a, Is<Summary> auto& v) {
  a("median_ms", v.median);
  a("min_ms", v.min);
  a("q1_ms", v.q1);
  a("q3_ms", v.q3);
  a("p95_ms", v.p95);
  a("ci95_ms", v.ci95);
  a("samples_ms", v.samples);
}

void fields(auto& a, Is<PassTiming> auto& v) {
  a("name", v.pass);
  fields(a, v.ms);
}

void fields(auto& a, Is<FrameTiming> auto& v) {
  a("span_ms", v.span.median);
  a("sum_ms", v.sum_ms);
  a("unattributed_ms", v.unattributed_ms);
  a("span", v.span);
  a("method", v.method);
  a("host_visibility", v.host_visibility);
}

void fields(auto& a, Is<FluxResult> auto& v) {
  a("value", v.value);
  a("ci95", v.ci95);
  a("min", v.least);
  a("max", v.most);
}

void fields(auto& a, Is<GenerateResult> auto& v) {
  a("gbuffer_ms", v.gbuffer_ms);
  a("rsm_ms", v.rsm_ms);
  a("total", v.total);
  a("lights", v.lights);
  a("empty", v.empty);
  a("overlap", v.overlap);
  a("gap", v.gap);
  a("shaders", v.shaders);
  a("dispatches", v.dispatches);
  a("memory_bytes", v.memory_bytes);
  a("flux", v.flux);
}

void fields(auto& a, Is<ShadingResult> auto& v) {
  a("clamp_removed", v.clamp_removed);
  a("cancellation_rate", v.cancellation_rate);
}

void fields(auto& a, Is<Stopping> auto& v) {
  a("reason", v.reason);
  a("frames", v.frames);
  a("warmup_frames", v.warmup_frames);
}

void fields(auto& a, Is<MetricResult> auto& v) {
  a("value", v.value);
  a("ci95", v.ci95);
  a("formula", v.formula);
  a("constants", v.constants);
  a.unless_empty("undefined", v.undefined);
  a.unless_default("heavy_tailed", v.heavy_tailed);
  a("median", v.median);
  a("least", v.least);
  a("largest", v.largest);
}

void fields(auto& a, Is<ErrorQuantiles> auto& v) {
  a("p50", v.p50);
  a("p99", v.p99);
  a("p99_9", v.p999);
}

void fields(auto& a, Is<ReferenceInfo> auto& v) {
  a("hash", v.hash);
  a("samples", v.samples);
  a("noise_floor_smape", v.noise_floor_smape);
  a("noise_floor_rmse", v.noise_floor_rmse);
  a("noise_floor_smape_lit", v.noise_floor_smape_lit);
  a("noise_floor_rrmse", v.noise_floor_rrmse);
  a("noise_floor_mrse", v.noise_floor_mrse);
  a("noise_floor_flip", v.noise_floor_flip);
  a("light_ratio", v.light_ratio);
  a("black_share", v.black_share);
  a("batches", v.batches);
  a("standard_error", v.standard_error);
  a("ended_by", v.ended_by);
}

void fields(auto& a, Is<Accuracy> auto& v) {
  a("smape", v.smape);
  a("rmse", v.rmse);
  a("rrmse", v.rrmse);
  a("mrse", v.mrse);
  a("bias", v.bias);
  a.unless_empty("smape_lit", v.smape_lit);
  a("lit_share", v.lit_share);
  a.unless_empty("flip", v.flip);
  a("flip_p99", v.flip_p99);
  a("quantiles", v.quantiles);
  a("reference", v.reference);
  a("pixels", v.pixels);
  a("below_floor", v.below_floor);
}

void fields(auto& a, Is<Coverage> auto& v) {
  a("overlap", v.overlap);
  a("gap", v.gap);
  a("pdf_overlap", v.pdf_overlap);
  a("pdf_gap", v.pdf_gap);
}

void fields(auto& a, Is<KernelStats> auto& v) {
  a("largest", v.largest);
  a("mean", v.mean);
  a("over", v.over);
  a("spread", v.spread);
}

void fields(auto& a, Is<RegionErrors> auto& v) {
  a("smape", v.smape);
  a("rmse", v.rmse);
  a("bias", v.bias);
  a("detail", v.detail);
}

void fields(auto& a, Is<SeedResult> auto& v) {
  a("seed", v.seed);
  a("smape", v.errors.smape);
  a("rmse", v.errors.rmse);
  a("rrmse", v.errors.rrmse);
  a("mrse", v.errors.mrse);
  a("bias", v.errors.bias);
  a("smape_lit", v.errors.smape_lit);
  a("flip", v.errors.flip);
  a("flip_p99", v.errors.flip_p99);
  a("p99_9", v.errors.p99_9);
  a("flux", v.flux);
  a("coverage", v.coverage);
  a("kernels", v.kernels);
  a("detail", v.detail);
  a("spikes", v.spikes);
  a("cancellation_rate", v.cancellation_rate);
  a("region", v.region);
}

void fields(auto& a, Is<FlickerSeries> auto& v) {
  a("value", v.value);
  a("p99", v.p99);
  a("worst_frame", v.worst_frame);
  a("series", v.series);
  a("ci95", v.ci95);
  a("formula", v.formula);
  a.unless_empty("values", v.values);
}

void fields(auto& a, Is<DetailResult> auto& v) {
  a("value", v.value);
  a("gain", v.gain);
  a("ci95", v.ci95);
  a("formula", v.formula);
  a.unless_empty("values", v.values);
}

void fields(auto& a, Is<Temporal> auto& v) {
  a("derivative", v.derivative);
  a("static", v.still);
  a("detail", v.detail);
  a("noise_floor", v.noise_floor);
  a("unlit", v.unlit);
  a("frames", v.frames);
  a("seeds", v.seeds);
  a("references", v.references);
}

void fields(auto& a, Is<FirstBad> auto& v) {
  a.unless_empty("pass", v.pass);
  a("pixel", v.pixel);
  a("light", v.light);
  a.unless_empty("buffer", v.buffer);
  a.unless_empty("field", v.field);
  a("element", v.element);
  a("texel", v.texel);
  a("level", v.level);
}

void fields(auto& a, Is<HealthReport> auto& v) {
  a("nan", v.nan);
  a("inf", v.inf);
  a("negative", v.negative);
  a("first_bad", v.first_bad);
}

void fields(auto& a, Is<CaseError> auto& v) {
  a("kind", v.kind);
  a("message", v.message);
}

void fields(auto& a, Is<CaseResult> auto& v) {
  a("id", v.id);
  a("scene", v.scene);
  a("method", v.method);
  a.unless_default("measure", v.measure);
  a("parameters", v.parameters);
  a("status", v.status);
  a("error", v.error);
  a.unless_empty("passes", v.passes);
  a("frame", v.frame);
  a("generate", v.generate);
  a("shading", v.shading);
  a("stopping", v.stopping);
  a("accuracy", v.accuracy);
  a.unless_empty("seeds", v.seeds);
  a("temporal", v.temporal);
  a("health", v.health);
  a.unless_empty("images", v.images);
}

}  // namespace vsglbench
