! A scene in Fortran: a pendulum in Cartesian coordinates with a position constraint.
!
!   gfortran -O2 -shared -fPIC pendulum_scene.f90 -o pendulum_scene.so
!   irk solve pendulum_scene.so --tol 1e-8 --formulation index3
!
! Unknowns u = (x, y), the multiplier z of the constraint: y = (u1, u2, v1, v2, z), w = (u1'', u2''). The functions are
! described in irk/scene_c.h; a C number of type int is integer(c_int), values are passed with `value`.
module pendulum_scene
  use iso_c_binding
  implicit none
  real(c_double), parameter :: m = 1, l = 1, g = 9.81d0  ! kg, m, m/s^2

  type, bind(c) :: sizes
    integer(c_int) :: nu, nx, nz, constraints, discrete, switches, times, outputs, algebraic_index, concurrent
  end type

contains

  integer(c_int) function version() bind(c, name="irk_scene_version")
    version = 1
  end function

  subroutine title(text) bind(c, name="irk_scene_title")
    character(kind=c_char), intent(inout) :: text(*)
    call put("a pendulum with a position constraint, in Fortran", text)
  end subroutine

  subroutine size_of(self, n) bind(c, name="irk_scene_size")
    type(c_ptr), value :: self
    type(sizes), intent(inout) :: n
    n%nu = 2
    n%nz = 1
    n%constraints = 1
    n%outputs = 1
    n%concurrent = 1
  end subroutine

  subroutine component(self, i, name, unit, scale, rate_scale) bind(c, name="irk_scene_component")
    type(c_ptr), value :: self
    integer(c_int), value :: i
    character(kind=c_char), intent(inout) :: name(*), unit(*)
    real(c_double), intent(inout) :: scale, rate_scale
    select case (i)
    case (0)
      call put("x", name)
    case (1)
      call put("y", name)
    case default
      call put("lambda", name)
    end select
    if (i == 2) then
      call put("N/m", unit)
      scale = 10
    else
      call put("m", unit)
      rate_scale = 5
    end if
  end subroutine

  subroutine start(self, t, y, w, d) bind(c, name="irk_scene_start")
    type(c_ptr), value :: self
    real(c_double), intent(inout) :: t(2), y(5), w(2), d(*)
    t(2) = 2
    y(1) = l
  end subroutine

  ! The rows that are to be zero: -m u'' + f - G^T z.
  integer(c_int) function residual(self, t, y, w, d, r) bind(c, name="irk_scene_residual")
    type(c_ptr), value :: self
    real(c_double), value :: t
    real(c_double), intent(in) :: y(5), w(2), d(*)
    real(c_double), intent(inout) :: r(2)
    r(1) = -m * w(1) - y(1) * y(5)
    r(2) = -m * w(2) - m * g - y(2) * y(5)
    residual = 0
  end function

  ! (u.u - l^2) / 2 and its first and second derivative with respect to time.
  integer(c_int) function constraints(self, level, t, y, w, c) bind(c, name="irk_scene_constraints")
    type(c_ptr), value :: self
    integer(c_int), value :: level
    real(c_double), value :: t
    real(c_double), intent(in) :: y(5), w(2)
    real(c_double), intent(inout) :: c(1)
    select case (level)
    case (0)
      c(1) = (y(1)**2 + y(2)**2 - l**2) / 2
    case (1)
      c(1) = y(1) * y(3) + y(2) * y(4)
    case default
      c(1) = y(3)**2 + y(4)**2 + y(1) * w(1) + y(2) * w(2)
    end select
    constraints = 0
  end function

  subroutine output(self, i, name, unit, invariant) bind(c, name="irk_scene_output")
    type(c_ptr), value :: self
    integer(c_int), value :: i
    character(kind=c_char), intent(inout) :: name(*), unit(*)
    integer(c_int), intent(inout) :: invariant
    call put("energy", name)
    call put("J", unit)
    invariant = 1
  end subroutine

  subroutine outputs(self, t, y, w, d, values) bind(c, name="irk_scene_outputs")
    type(c_ptr), value :: self
    real(c_double), value :: t
    real(c_double), intent(in) :: y(5), w(2), d(*)
    real(c_double), intent(inout) :: values(1)
    values(1) = m * ((y(3)**2 + y(4)**2) / 2 + g * y(2))
  end subroutine

  ! Writes a text of C: its letters, then a 0.
  subroutine put(from, to)
    character(*), intent(in) :: from
    character(kind=c_char), intent(inout) :: to(*)
    integer :: i
    do i = 1, len(from)
      to(i) = from(i:i)
    end do
    to(len(from) + 1) = c_null_char
  end subroutine

end module
