// Measured data over time: a column of a CSV file as a function of t, for a scene of your own.
//
//   TimeTable<Real> torque{"torque.csv", "t", "M"};                          // a member of the scene's struct
//   TimeTable<Real> torque{"torque.csv", "t", "M", Interpolation::kCubic};
//   ... r.u[0] = p.a[0] - torque(p.t);                                   // in its functions
//
// The file lies beside the scene's file. Its first line names the columns; cells are separated by ',', ';' or tabs, and
// decimals have a point. Empty lines and lines that begin with '#' are skipped. Times ascend.
//
// Nothing else is to be said: the times at which the table has a kink are declared (times() in irk/problem.h), so that
// steps end there, and the file's content is part of the scene: with other numbers runs and references are made anew.
// A run from or to a time that the table does not have is refused.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

namespace irk {

enum class Interpolation {
  kLinear,  ///< between the rows; kinks are the rows at which the slope changes
  /// A cubic between two rows that is monotone where the data is, with a continuous first derivative: F. N. Fritsch,
  /// J. Butland, SIAM J. Sci. Stat. Comput. 5 (1984) 300-304, after Fritsch & Carlson, SIAM J. Numer. Anal. 17 (1980)
  /// 238-246; at both ends the formula of three points of MATLAB's pchip. Its second derivative jumps at the rows: they
  /// are kinks, too.
  kCubic,
};

/// What a table has read, as decimal text.
struct TableRead {
  std::string file, column;
  std::string first, last;         ///< times of the first and the last row
  std::vector<std::string> kinks;  ///< times between them
};

/// As long as an object exists, tables that are made on this thread read files of `folder` (the working folder if it is
/// empty), and their kinks belong to the scene that is made (makeScene). Objects may be nested.
class TableReadings {
 public:
  explicit TableReadings(std::string folder);
  ~TableReadings();
  TableReadings(const TableReadings&) = delete;
  TableReadings& operator=(const TableReadings&) = delete;

  const std::vector<TableRead>& all() const { return all_; }

 private:
  friend struct TableColumns;
  std::string folder_;
  std::vector<TableRead> all_;
  TableReadings* outer_;
};

/// Two columns of a file, as decimal text of finite numbers with ascending t.
struct TableColumns {
  std::vector<std::string> t, y;
  std::vector<std::string> kinks;  ///< the times between the first and the last at which the slope changes

  /// Reads a file and adds it to the TableReadings of this thread. Throws Misuse, with the file, and with the line
  /// where there is one, for a file that cannot be read, a column that it does not have (naming those that it has), a
  /// line with more or fewer cells than the first, a cell that is not a finite number, times that do not ascend, and
  /// fewer than two rows.
  /// `time` may be empty: the first column.
  static TableColumns read(const std::string& file, const std::string& time, const std::string& y);
};

/// The kinks of all tables that the TableReadings of this thread have so far; any order.
std::vector<std::string> kinksRead();

template <class Real>
Real decimal(const char* text);

/// Immutable; copies share the numbers.
template <class Real>
class TimeTable {
 public:
  /// `file`: beside the scene's file; outside of scenes relative to the working folder. `t`, `y`: names of columns.
  /// Throws Misuse as TableColumns::read.
  TimeTable(const std::string& file, const std::string& t, const std::string& y,
            Interpolation interpolation = Interpolation::kLinear) {
    const TableColumns columns = TableColumns::read(file, t, y);
    std::vector<Real> times, values;
    for (const auto& text : columns.t) times.push_back(decimal<Real>(text.c_str()));
    for (const auto& text : columns.y) values.push_back(decimal<Real>(text.c_str()));
    for (const auto& text : columns.kinks) kinks_.push_back(decimal<Real>(text.c_str()));
    last_ = times.back();
    pieces_ = std::make_shared<const std::vector<Piece>>(piecesOf(times, values, interpolation));
  }

  /// The value at t, a number or a dual number. Before the first and after the last row the outermost piece goes on:
  /// scenes do not run there.
  template <class T>
  T operator()(const T& t) const {
    const auto after = std::upper_bound(pieces_->begin() + 1, pieces_->end(), plain(t),
                                        [](const Real& at, const Piece& piece) { return at < piece.t; });
    const Piece& p = *(after - 1);
    const T s = t - p.t;
    return ((s * p.c3 + p.c2) * s + p.c1) * s + p.c0;
  }

  Real first() const { return pieces_->front().t; }
  Real last() const { return last_; }
  /// The times of the rows at which it has a kink, for times() of a problem that is not made by a scene.
  const std::vector<Real>& kinks() const { return kinks_; }

 private:
  /// c0 + c1 s + c2 s^2 + c3 s^3 with s = time - t, up to the next piece.
  struct Piece {
    Real t, c0, c1, c2, c3;
  };

  template <class T>
  static const auto& plain(const T& t) {
    if constexpr (requires { t.value; }) {
      return plain(t.value);
    } else {
      return t;
    }
  }

  static std::vector<Piece> piecesOf(const std::vector<Real>& t, const std::vector<Real>& y, Interpolation by) {
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i + 1 < t.size(); ++i) {
      pieces.push_back({t[i], y[i], (y[i + 1] - y[i]) / (t[i + 1] - t[i]), Real(0), Real(0)});
    }
    if (by == Interpolation::kLinear) return pieces;
    const std::vector<Real> d = slopesAtRows(t, pieces);
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      Piece& p = pieces[i];
      const Real h = t[i + 1] - t[i], secant = p.c1;
      p.c1 = d[i];
      p.c2 = (3.0 * secant - 2.0 * d[i] - d[i + 1]) / h;
      p.c3 = (d[i] - 2.0 * secant + d[i + 1]) / (h * h);
    }
    return pieces;
  }

  // `secants`: pieces whose c1 are the slopes between the rows.
  static std::vector<Real> slopesAtRows(const std::vector<Real>& t, const std::vector<Piece>& secants) {
    const std::size_t n = secants.size();
    std::vector<Real> d(n + 1, Real(0));
    const auto h = [&t](std::size_t i) -> Real { return t[i + 1] - t[i]; };
    const auto secant = [&secants](std::size_t i) { return secants[i].c1; };
    for (std::size_t i = 1; i < n; ++i) {  // a harmonic mean; 0 at a turning point of the data
      if (!(secant(i - 1) * secant(i) > Real(0))) continue;
      const Real w0 = 2.0 * h(i) + h(i - 1), w1 = h(i) + 2.0 * h(i - 1);
      d[i] = (w0 + w1) / (w0 / secant(i - 1) + w1 / secant(i));
    }
    d[0] = n == 1 ? secant(0) : slopeAtEnd(h(0), h(1), secant(0), secant(1));
    d[n] = n == 1 ? secant(0) : slopeAtEnd(h(n - 1), h(n - 2), secant(n - 1), secant(n - 2));
    return d;
  }
  // The outermost piece has the step h and the secant s, the next one h1 and s1.
  static Real slopeAtEnd(const Real& h, const Real& h1, const Real& s, const Real& s1) {
    const Real d = ((2.0 * h + h1) * s - h * s1) / (h + h1);
    if (!(d * s > Real(0))) return Real(0);
    const Real most = 3.0 * s;
    const bool turns = !(s * s1 > Real(0)), steep = (d - most) * s > Real(0);
    return turns && steep ? most : d;
  }

  std::shared_ptr<const std::vector<Piece>> pieces_;
  std::vector<Real> kinks_;
  Real last_;
};

}  // namespace irk
